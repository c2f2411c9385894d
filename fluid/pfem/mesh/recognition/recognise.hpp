// Which Delaunay cells are fluid? The old boundary, advected with its nodes, decides.
//
// With R the circumradius of a cell and h the element size at it:
//   R > 8 h                      not fluid, but for slivers that are closed in by fluid and walls
//   R < 0.8 h, an inner node     fluid
//   R < 0.3 h, boundary nodes    fluid unless inside a wall: lets two parts of fluid join
//   else                         fluid if the centroid lies inside the advected old boundary
// The single threshold of the alpha-shape method is the main noise in PFEM loads: it drops cells under the
// pressure peak or bridges the cavity under a jet (docs/theory.md). Cf. arXiv 2512.20347.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/delaunay/delaunay.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/recognition/at_walls.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Circumradius over element size at which a cell ...
struct Alpha {
  double never = 8.0;  ///< ... spans a gap
  double inner = 0.8;  ///< ... around an inner node is surely fluid
  double join = 0.3;   ///< ... joins two surfaces; 0.8 would fill the cavity under a jet
};

/// A point deep in the solid that a wall encloses (hubs.hpp).
template <int d>
struct Hub {
  int wall;
  Vec<d> x;
};

/// Flat cells with water all around, which are neither cells nor surface.
template <int d>
using FlatCells = std::vector<std::array<int, d + 1>>;

/// The fluid's cells and boundary, and what was noticed on the way.
template <int d>
struct Recognised : Mesh<d> {
  /// Inner nodes, off walls, of cells that lie in a wall for some part, in 3D, though water should be there: without
  /// them the triangulation has the wall's facets.
  std::vector<int> piercing;
  FlatCells<d> flat_cells;    ///< closed in by water
  bool hub_in_water = false;  ///< cells of a hub hold some of it; nothing else has been looked at
};

/// Finds the fluid cells among `all` and labels boundary facets; sets nodes.surface and nodes.spray.
/// `old_boundary`: closed facets between the same nodes.
template <int d>
Recognised<d> recognise(Delaunay<d> all, Nodes<d>& nodes, const std::vector<Facet<d>>& old_boundary,
                        const WallsAt<d>& walls, const Alpha& limit = {}, std::span<const Hub<d>> hubs = {});

/// Among the cells of the nodes' triangulation.
template <int d>
Recognised<d> recognise(Nodes<d>& nodes, const std::vector<Facet<d>>& old_boundary, const WallsAt<d>& walls,
                        const Alpha& limit = {});

}  // namespace splashdown::fluid
