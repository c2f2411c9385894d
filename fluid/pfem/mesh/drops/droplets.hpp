// Drops smaller than the mesh: nodes without cells (Nodes::spray) that fly under the effects alone, each with its own volume V.
// They are no corners of cells: three drops that meet in the air are not the water between them. With
//
//   s = (2 V / sqrt 3)^(1/2) in 2D,  (sqrt 2 V)^(1/3) in 3D,
//
// the size of elements whose nodes hold V each where they are packed most closely:
//
//   drops nearer to each other than the mean of their sizes join:      V = V_1 + V_2, mean position and velocity by volume
//   a drop in the liquid, also on a wall that the liquid wets, or nearer to its surface than s / 2, joins it: the nodes of the
//     nearest facet of the surface give way by V / d each, along the area around them, and take the momentum,
//     v <- (V_k v_k + V/d v) / (V_k + V/d); those on walls stay there, and their share of the volume is owed
//     (volume_correction.hpp)
//
// Both are plastic: volume (to first order in the shift, which is bounded) and momentum are kept, kinetic energy falls.
#pragma once

#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Size of a drop of this volume [m].
template <int d>
double drop_size(double volume);

/// Joins drops that touch; a drop grows no larger than the elements there. The nodes that are left.
template <int d>
std::vector<char> join_drops(Nodes<d>& nodes);

/// Joins drops with the liquid that `boundary` encloses. `left`: nodes that are still there; those that join are taken out.
template <int d>
void absorb_drops(Nodes<d>& nodes, const std::vector<Facet<d>>& boundary, const WallsAt<d>& walls,
                  std::vector<char>& left);

extern template double drop_size<2>(double);
extern template double drop_size<3>(double);
extern template std::vector<char> join_drops(Nodes<2>&);
extern template std::vector<char> join_drops(Nodes<3>&);
extern template void absorb_drops(Nodes<2>&, const std::vector<Facet<2>>&, const WallsAt<2>&, std::vector<char>&);
extern template void absorb_drops(Nodes<3>&, const std::vector<Facet<3>>&, const WallsAt<3>&, std::vector<char>&);

}  // namespace splashdown::fluid
