// What a wall does to the nodes tied to it: they slide along it, turn its corners, leave it where the flow does, and its edges
// hold some of them.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/contact/separation.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/pressure/held_mass.hpp"

namespace splashdown::fluid {

/// What ties nodes to walls on one mesh.
template <int d>
class WallMotion {
 public:
  /// `answers`: of walls, 1 for those whose motion is solved with the pressure.
  WallMotion(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls, std::span<const char> answers);

  /// Nodes with a pressure of their own slip: along a wall v.n = w.n is met by facets, in the mean that the pressure can
  /// keep, and not node by node, which would take momentum from the water that nobody gets. `unknown`: of nodes, -1: p = 0;
  /// `volume`: of the water around nodes [m^d].
  void meet_pressure(std::span<const int> unknown, std::span<const double> volume);

  /// Where a motion takes nodes.
  struct Moved {
    std::vector<Vec<d>> x;     ///< at t_{n+1}
    std::vector<Vec<d>> u;     ///< motion that counts for the volume: (x_{n+1} - x_n) / dt, or the fluid's
                               ///< velocity where it slips along a wall or separates from an edge
    std::vector<WallTie> tie;  ///< at t_{n+1}: nodes may leave their wall or turn a corner
    std::vector<int>
        slides;  ///< boundary facets where the wall's flux counts: those with nodes that slip, and chords of
                 ///< their curved wall that stay so
  };
  /// Moves all nodes by dt v and puts tied ones onto their wall at `poses`.
  void move(std::span<const Vec<d>> v, std::span<const WallPlace<d>> poses, double dt, Moved& out) const;

  /// Nodes that walls take along in more directions than pressure keeps them in: those in hollow edges and corners that are
  /// wetted on all sides. Along the normal of a smooth wall it is the pressure that does it.
  const std::vector<HeldNode<d>>& held() const { return held_; }
  /// What flows around an edge takes its place from upstream: the fluid's velocity there after the motion that `move` made of
  /// its velocities v, in place. First-order upwind, a convex combination.
  void convect(std::span<const Vec<d>> x, double dt, std::span<Vec<d>> u) const;

 private:
  const Nodes<d>& nodes_;
  const Mesh<d>& mesh_;
  std::span<const Wall<d>> walls_;
  void find_edges(const WallsAt<d>& walls, std::span<const char> answers);
  void move_drop(int i, const WallPlace<d>& pose, double dt, Moved& out) const;
  void move_tied(int i, const WallPlace<d>& pose, double dt, Moved& out) const;
  bool is_chord(int facet, std::span<const WallTie> tie) const;
  bool attached(int wall, const typename Wall<d>::Near& edge) const;

  std::vector<int> tied_;     // and free to slide, but for vertices
  std::vector<char> wetted_;  // node has a wetted facet
  std::vector<Separation<d>> separations_;
  std::vector<std::vector<char>> attached_vertex_;  // of each wall: wetted on all sides
  std::vector<int> on_creases_;                     // wetted nodes
  std::vector<HeldNode<d>> held_;
  std::vector<char> slips_;   // of nodes: their velocity is the water's, not that of their place on the wall
  std::vector<int> edges_;    // those of them at edges
  std::vector<int> by_flux_;  // facets with such a node
  std::vector<int> chords_;   // facets, at t_n
};

extern template class WallMotion<2>;
extern template class WallMotion<3>;

}  // namespace splashdown::fluid
