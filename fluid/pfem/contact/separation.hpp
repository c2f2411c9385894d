// Where the flow leaves a wall: at its edges. A node there goes with the edge, and the water that leaves it has the velocity
// with which it came (Kutta): what is at the edge and its wetted neighbours upstream become one. No momentum is lost in
// that, and no energy made.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/recognition/recognise.hpp"

namespace splashdown::fluid {

/// Finds the nodes at convex edges of walls where the flow leaves them (Nodes::separates): corners on the free surface, and
/// nodes of creases that are wetted on one side only and pass water fast, |v - w|^2 / 2 > g h upstream. Slower water
/// stands at a crease like at any other place of a wall. `velocities`: of the walls, `gravity`: g.
template <int d>
void separate(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
              std::span<const WallVelocity<d>> velocities, double gravity);

/// A node where the flow leaves an edge, and a wetted neighbour of it, with their shares of the difference of velocities.
template <int d>
struct Separation {
  int edge, neighbour;
  Vec<d> area = Vec<d>::Zero();  ///< of the boundary around the edge node; around both if the flow leaves both
  double taken = 0, given = 0;
};

/// The pairs of the nodes that `separate` has found with neighbours where no flow leaves, twice where two facets join them. A
/// node that has none meets what there is, other edge nodes: two of them are one pair, whichever sees the other.
template <int d>
std::vector<Separation<d>> separations(const Nodes<d>& nodes, const Mesh<d>& mesh);

/// The shares, from the volume of water around nodes [m^d]: with a and b what edge node i and neighbour j have for each other,
/// V_i and V_j shared among all pairs that they are in, and m = a b / (a + b),
///
///   taken = m / V_i,  given = m / V_j
///
/// A pair that is alone ends with the velocity of its centre of mass.
template <int d>
void share_momentum(std::span<const double> volume, std::span<Separation<d>> separations);

/// v_i += taken (v_j - v_i), v_j -= given (v_j - v_i), all at once; in 3D along the surface alone. Keeps momentum. The
/// energy does not grow: sum_j m <= V_i at every node, so that no eigenvalue of the exchange is beyond 2. `u`: of nodes, in
/// place.
template <int d>
void mix_with_upstream(std::span<const Separation<d>> separations, std::span<Vec<d>> u);

extern template void separate(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>, double);
extern template void separate(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>, double);
extern template std::vector<Separation<2>> separations(const Nodes<2>&, const Mesh<2>&);
extern template std::vector<Separation<3>> separations(const Nodes<3>&, const Mesh<3>&);
extern template void share_momentum<2>(std::span<const double>, std::span<Separation<2>>);
extern template void share_momentum<3>(std::span<const double>, std::span<Separation<3>>);
extern template void mix_with_upstream<2>(std::span<const Separation<2>>, std::span<Vec<2>>);
extern template void mix_with_upstream<3>(std::span<const Separation<3>>, std::span<Vec<3>>);

}  // namespace splashdown::fluid
