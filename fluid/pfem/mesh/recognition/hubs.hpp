// Hubs: points deep in solids that the triangulation has besides the nodes, in 3D.
//
// Nodes on a smooth hull nearly lie on one sphere. Which tetrahedra the Delaunay triangulation has between them, on the side
// of the solid, is decided by the last digits of their places: they change with every step, thousands under the hull of a
// capsule, and none of them is water. With a point in the depth each of its cells is spanned from there to a facet of the
// hull, and stays.
//
// A hub must not take cells from the water: those with a circumsphere of radius R that holds it. They reach from the hub to
// beyond the hull, so 2 R is more than its depth D, and the water has none with R > never h (recognise.hpp). So hulls have a
// hub where
//
//   D > 2 never max h   over the nodes on the hull.
//
// Cells of the coarser water around it, with circumspheres that reach into the solid through dry parts of the hull, are rare,
// but there may be some: then cells of the hub lie in the water, and the triangulation is made again without.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/surface/inside.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"

namespace splashdown::fluid {

/// None in 2D: there flips follow what changes, and cost next to nothing.
template <int d>
std::vector<Hub<d>> hubs_of(const Nodes<d>& nodes, const WallsAt<d>& walls, const Alpha& limit = {});

/// Whether cells of hubs hold water. `inside`: its advected boundary.
template <int d>
bool reach_water(const Delaunay<d>& all, std::span<const Hub<d>> hubs, const Nodes<d>& nodes,
                 const InsideTest<d>& inside);

extern template std::vector<Hub<2>> hubs_of(const Nodes<2>&, const WallsAt<2>&, const Alpha&);
extern template std::vector<Hub<3>> hubs_of(const Nodes<3>&, const WallsAt<3>&, const Alpha&);

}  // namespace splashdown::fluid
