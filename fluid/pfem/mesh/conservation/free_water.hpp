// Water that no wall touches: effects alone change its momentum.
//
// Nodal volumes change, V_i -> V_i', where nodes move, merge and part, where volume comes back and where the water is
// triangulated anew; velocities stay with the nodes. For each connected part that no wall touches, with
//
//   M = sum V_i,  P = sum V_i v_i,  T = 1/2 sum V_i |v_i|^2 - |P|^2 / 2 M     of all that its nodes carried before
//   M', w' = sum V_i' v_i / M', T'                                             of them afterwards
//
//   v_i <- P / M + min(1, (T / T')^1/2) (v_i - w')
//
// keeps the mean velocity, and the motion about it gains no energy. The momentum of volume that a part has lost, (M - M') P / M,
// goes where that volume goes (volume_correction.hpp): to parts that have gained, as far as they have,
//
//   P / M <- (P + delta w) / (M + delta),   delta their share of it, w its mean velocity
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Flat walls take momentum along their normals alone. Water that touches no others keeps what it has along all of them: with the
/// projector Q on the directions that no wall of the part pushes in, none where there are edges or curved walls,
///
///   v_i <- v_i + Q (P / M - w')
///
/// What energy that brings is taken out with what the new mesh has brought (field_energy.hpp).
/// Which parts of the water keep momentum, and along what. What the exchange between parts leaves of momentum goes to the largest
/// part; of a single one P is kept. A uniform shift is the least change of velocities that does it, and no strain.
template <int d>
class FreeWater {
 public:
  /// Of each part, at its first node; nothing where no part keeps any.
  using Moments = std::vector<VelocityMoments<d>>;

  FreeWater() = default;
  /// Which water of `mesh` hangs together, and in which directions walls push none of it.
  FreeWater(const Mesh<d>& mesh, const Nodes<d>& nodes, const WallsAt<d>& walls);

  /// Of each node the first one of its part (parts_of).
  const std::vector<int>& part() const { return part_; }
  /// Whether the node is a corner of cells of a part that no wall touches.
  bool has(std::size_t node) const { return any_ && directions_of(node) == all; }
  /// What no wall changes of a velocity of the node's part.
  Vec<d> kept(std::size_t node, const Vec<d>& v) const;

  /// What nodal volumes with these velocities amount to, and, if not empty, what nodes have inherited.
  Moments moments(std::span<const double> volumes, std::span<const Vec<d>> v,
                  std::span<const VelocityMoments<d>> inherited = {}) const;
  /// Gives parts the velocity that they had, with that of the volume that they got from others, free ones with no more energy,
  /// and the largest one what is left of momentum.
  void give_back(const Moments& had, std::span<const double> volumes, std::vector<Vec<d>>& v) const;

 private:
  static constexpr int drop = 0, none = 1, all = 2;  // more than `all`: some
  /// Which directions the node's part keeps: of directions_.
  int directions_of(std::size_t node) const { return kept_[part_[node]]; }
  bool keeps_any(std::size_t node) const { return directions_of(node) >= all; }

  bool any_ = false;
  std::vector<int> part_;
  std::vector<int> kept_;  // of the first node of each part
  std::vector<Mat<d>> directions_{Mat<d>::Zero(), Mat<d>::Zero(), Mat<d>::Identity()};  // projectors
};

extern template class FreeWater<2>;
extern template class FreeWater<3>;

}  // namespace splashdown::fluid
