// Mass that moves with walls. Nodes in hollow edges and corners of a wall move with the wall in
// some directions P_i (a projector): their mass there is the wall's. With N_i s the wall's velocity at node i, m_i its mass
// and a_i(phi) the change of velocity that the pressure impulse phi gives to a free node, the wall receives
//
//   sum_i N_i^T P_i m_i (v_i + a_i(phi) - N_i s)  =  e + R phi - M_h (s - s~),    M_h = sum_i N_i^T P_i m_i N_i
//
// e = sum_i N_i^T P_i m_i (v_i - N_i s~). R is a load operator beside B, M_h an inertia beside the body's: a body that answers
// the pressure answers this in the same equation, at any mass (docs/design-notes). Handed over afterwards, it is a fixed-point
// iteration with the gain M_h / (M + added mass).
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/node_cells.hpp"
#include "fluid/pfem/wall_place.hpp"

namespace splashdown::fluid {

/// A node whose mass moves with a wall in some directions.
template <int d>
struct HeldNode {
  int node;           ///< index
  int wall;           ///< index of the wall that holds it
  Vec<d> arm;         ///< from the wall's reference point, at t_n [m]
  Mat<d> directions;  ///< P: projects on those in which it moves with the wall
};

/// What a pressure impulse does to the velocity of free nodes, as PressureEquation::accelerate computes it.
template <int d>
struct AccelerationWeights {
  const Mesh<d>& mesh;                            ///< at t_n
  std::span<const Vec<d>> x;                      ///< of nodes, at t_n [m]
  const NodeCells<d>& around;                     ///< the cells around each node
  std::span<const VolumeGradients<d>> gradients;  ///< of cells
  std::span<const double> cell_mass_share;        ///< of cells: mass / (d + 2)
  std::span<const double> per_nodal_mass;         ///< of nodes: 1 / ((d + 1) mass)
};

/// Load, inertia and momentum of all held nodes of rigid walls, world frame, about the walls' reference points.
template <int d>
class HeldMass {
 public:
  /// `lumped`: masses of nodes over the density [m^d].
  void build(std::vector<HeldNode<d>> held, std::size_t walls, double density, std::span<const double> lumped);
  /// Whether no node is held.
  bool empty() const { return held_.empty(); }
  /// The wrench on a wall, about its reference point, per pressure impulse at a node [N s / Pa s].
  struct Column {
    int node;          ///< index
    Wrench<d> wrench;  ///< of a unit of pressure impulse
  };
  /// R of a wall, by the nodes whose pressure impulse has a part in it.
  std::vector<Column> load(std::size_t wall, const AccelerationWeights<d>& weights) const;
  /// M_h of a wall [kg, kg m, kg m^2; 2D: per metre].
  Mat<freedoms<d>> inertia(std::size_t wall) const;
  /// sum_i N_i^T P_i m_i (v_i - N_i s), a wrench a wall.
  std::vector<WallImpulse<d>> excess(std::span<const Vec<d>> v, std::span<const WallVelocity<d>> s) const;
  /// Gives held nodes their wall's velocity in the directions P.
  void hold(std::span<Vec<d>> v, std::span<const WallVelocity<d>> s) const;

 private:
  using Lever = Eigen::Matrix<double, freedoms<d>, d>;  // N^T
  static Lever lever(const Vec<d>& arm);

  std::vector<HeldNode<d>> held_;  // by wall
  std::vector<int> first_;         // of each wall, and one beyond
  std::vector<double> mass_;       // of held nodes [kg]
};

extern template class HeldMass<2>;
extern template class HeldMass<3>;

}  // namespace splashdown::fluid
