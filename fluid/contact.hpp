// Where fluid meets walls: nodes that reach a wall slide on it, corners and creases keep nodes, nodes
// that pass a sharp edge or part from the wall leave it. Only fluid carries nodes: there are no dry wall
// nodes, so no cell spans a gap and contact neither creates volume nor happens early.
#pragma once

#include <span>
#include <vector>

#include "fluid/recognise.hpp"

namespace splashdown::fluid {

/// Ties nodes that have reached a wall; puts nodes at wetted corners and creases. `velocities`: of the walls.
template <int d>
void wet(Nodes<d>& nodes, std::vector<double>& h, Mesh<d>& mesh, const WallsAt<d>& walls,
         std::span<const Twist<d>> velocities);

/// Lets air in: a wetted node beside the contact line or beside an edge leaves its wall under suction,
/// p < -0.1 rho |v - w|^2 / 2. Inviscid flow would otherwise cling to a sharp edge with any suction.
template <int d>
void ventilate(Nodes<d>& nodes, const Mesh<d>& mesh, double density, std::span<const Twist<d>> velocities,
               std::span<const Isometry<d>> poses);

/// Finds the nodes at edges of walls where the flow leaves them (Nodes::separates): corners on the free surface, and
/// nodes of creases that are wetted on one side only and pass water fast, |v - w|^2 / 2 > g h upstream. Slower water
/// stands at a crease like at any other place of a wall. `h`: element sizes, `velocities`: of the walls, `gravity`: g.
template <int d>
void separate(Nodes<d>& nodes, std::span<const double> h, const Mesh<d>& mesh, const WallsAt<d>& walls,
              std::span<const Twist<d>> velocities, double gravity);

/// What ties nodes to walls on one mesh.
template <int d>
class WallMotion {
 public:
  WallMotion(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls);

  struct Moved {
    std::vector<Vec<d>> x;     ///< at t_{n+1}
    std::vector<Vec<d>> u;     ///< motion that counts for the volume: (x_{n+1} - x_n) / dt, or the fluid's
                               ///< velocity at an edge where the flow separates
    std::vector<WallTie> tie;  ///< at t_{n+1}: nodes may leave their wall or turn a corner
    std::vector<int> slides;   ///< boundary facets that are chords of their curved wall and stay so
  };
  /// Moves all nodes by dt v and puts tied ones onto their wall at `poses`.
  void move(std::span<const Vec<d>> v, std::span<const Isometry<d>> poses, double dt, Moved& out) const;

  /// Walls take some nodes along in more than one direction: edges that are wetted on both sides, and WallSpec::sticks
  /// away from the contact line.
  bool drags() const { return !stuck_.empty() || !on_creases_.empty(); }
  /// Impulses on the walls, about their origins, of what that takes from the velocities v: u is the motion that `move`
  /// made of v, `volume` that of the nodes. Along the normal of a smooth wall it is the pressure's.
  void drag(std::span<const Vec<d>> v, std::span<const Vec<d>> u, double density, std::span<const double> volume,
            std::vector<Wrench<d>>& on_walls) const;

 private:
  const Nodes<d>& nodes_;
  const Mesh<d>& mesh_;
  std::span<const Wall<d>> walls_;
  void find_stuck(const Mesh<d>& mesh, const WallsAt<d>& walls);
  void find_separations(const Mesh<d>& mesh);
  bool is_chord(int facet, std::span<const WallTie> tie) const;
  bool attached(int wall, const typename Wall<d>::Near& edge) const;

  std::vector<int> tied_;  // and free to slide, but for vertices
  struct Stuck {
    int node;
    Vec<d> place;   // in the wall's frame
    Vec<d> arm;     // from the wall's origin, at t_n
    Vec<d> normal;  // of its wetted facets, unit
  };
  std::vector<Stuck> stuck_;
  std::vector<char> wetted_;  // node has a wetted facet
  struct Separation {
    int at;
    std::vector<int> upstream;  // wetted neighbours it takes its velocity from
    Vec<d> area;                // of the boundary around it
  };
  std::vector<Separation> separations_;
  std::vector<std::vector<char>> attached_vertex_;  // of each wall: wetted on all sides
  struct OnCrease {
    int node;
    Vec<d> arm;  // from the wall's origin, at t_n
  };
  std::vector<OnCrease> on_creases_;  // wetted
  std::vector<int> chords_;           // facets, at t_n
};

extern template class WallMotion<2>;
extern template class WallMotion<3>;

}  // namespace splashdown::fluid
