// Water that lands: what becomes of velocities where nodes get water that they did not carry.
#pragma once

#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Whether corners of a cell were of different parts of the last mesh, Nodes::part: it is new water then, that no node
/// carries yet.
template <int d>
bool joins_parts(const std::array<int, d + 1>& cell, const Nodes<d>& nodes);

/// Facets of the boundary, those of smaller parts of the last mesh first: where surfaces have met and facets cross, a
/// triangulation keeps the first. So what lands keeps its shape, and the water that it lands in makes room, which has nodes
/// enough.
template <int d>
std::vector<Facet<d>> smaller_parts_first(const std::vector<Facet<d>>& boundary, const Nodes<d>& nodes);

/// Cells that join parts are owed by all the water that hangs together now, and come with its mean velocity w: with S_i the share
/// of node i in such cells and V_i what it carries,
///
///   v_i <- (V_i v_i + S_i w) / (V_i + S_i)
///
/// Momentum about w stays, energy about w does not grow. `part`: parts_of of this mesh; becomes Nodes::part. O(cells).
template <int d>
void mix_joined(const Mesh<d>& mesh, const std::vector<int>& part, Nodes<d>& nodes);

/// Drops that land in the water they came from become part of much larger cells. They bring their own momentum and no more,
///
///   v <- w + V_before / V (v - w),   w mean velocity of the new neighbours, by their volume
///
/// where the volume V around a node on `mesh` is more than three times Nodes::volume: remeshing alone hardly doubles it. They
/// also forget their pressure.
template <int d>
void mix_absorbed(Nodes<d>& nodes, const Mesh<d>& mesh);

extern template bool joins_parts(const std::array<int, 3>&, const Nodes<2>&);
extern template bool joins_parts(const std::array<int, 4>&, const Nodes<3>&);
extern template std::vector<Facet<2>> smaller_parts_first(const std::vector<Facet<2>>&, const Nodes<2>&);
extern template std::vector<Facet<3>> smaller_parts_first(const std::vector<Facet<3>>&, const Nodes<3>&);
extern template void mix_joined(const Mesh<2>&, const std::vector<int>&, Nodes<2>&);
extern template void mix_joined(const Mesh<3>&, const std::vector<int>&, Nodes<3>&);
extern template void mix_absorbed(Nodes<2>&, const Mesh<2>&);
extern template void mix_absorbed(Nodes<3>&, const Mesh<3>&);

}  // namespace splashdown::fluid
