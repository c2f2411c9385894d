// Where the flow leaves a wall: at its edges. A node there goes with the edge, and the water that leaves it has the velocity
// with which it came (Kutta): that of its wetted neighbours upstream.
#pragma once

#include <span>
#include <vector>

#include "fluid/mesh/recognise.hpp"

namespace splashdown::fluid {

/// Finds the nodes at edges of walls where the flow leaves them (Nodes::separates): corners on the free surface, and
/// nodes of creases that are wetted on one side only and pass water fast, |v - w|^2 / 2 > g h upstream. Slower water
/// stands at a crease like at any other place of a wall. `h`: element sizes, `velocities`: of the walls, `gravity`: g.
template <int d>
void separate(Nodes<d>& nodes, std::span<const double> h, const Mesh<d>& mesh, const WallsAt<d>& walls,
              std::span<const Twist<d>> velocities, double gravity);

/// A node where the flow leaves an edge.
template <int d>
struct Separation {
  int at;
  std::vector<int> upstream;  ///< wetted neighbours that it takes its velocity from
  Vec<d> area;                ///< of the boundary around it
};

/// Of the nodes that `separate` has found, those with wetted neighbours.
template <int d>
std::vector<Separation<d>> separations(const Nodes<d>& nodes, const Mesh<d>& mesh);

/// What leaves has the mean velocity of what comes, in space along the surface alone. `u`: of nodes, in place.
template <int d>
void take_from_upstream(std::span<const Separation<d>> separations, std::span<Vec<d>> u);

extern template void separate(Nodes<2>&, std::span<const double>, const Mesh<2>&, const WallsAt<2>&,
                              std::span<const Twist<2>>, double);
extern template void separate(Nodes<3>&, std::span<const double>, const Mesh<3>&, const WallsAt<3>&,
                              std::span<const Twist<3>>, double);
extern template std::vector<Separation<2>> separations(const Nodes<2>&, const Mesh<2>&);
extern template std::vector<Separation<3>> separations(const Nodes<3>&, const Mesh<3>&);
extern template void take_from_upstream<2>(std::span<const Separation<2>>, std::span<Vec<2>>);
extern template void take_from_upstream<3>(std::span<const Separation<3>>, std::span<Vec<3>>);

}  // namespace splashdown::fluid
