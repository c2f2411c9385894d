// A wall as the fluid meets it.
#pragma once

#include <span>
#include <vector>

#include "core/anchor.hpp"
#include "core/fluid_view.hpp"

namespace splashdown::apps {

/// Where a fluid wets a wall: looks at the spans of a view, copies nothing.
template <int d>
struct WallFacets {
  std::span<const Vec<d>> points;              ///< of the fluid, world frame [m]
  std::span<const Facet<d>> boundary;          ///< of the fluid; those of other walls are passed over
  int wall = -1;                               ///< its index
  Isometry<d> pose = Isometry<d>::Identity();  ///< wall frame to world
};

template <int d>
WallFacets<d> wall_facets(const FluidView<d>& fluid, int wall) {
  return {fluid.points(), fluid.boundary(), wall, fluid.wall_poses()[static_cast<std::size_t>(wall)]};
}

/// Of all points of the fluid on a wall that deforms: where what of the wall they touch was at t = 0, world frame [m]; others
/// stay where they are. Of a rigid wall: none.
template <int d>
std::vector<Vec<d>> points_at_rest(const FluidView<d>& fluid, int wall) {
  const auto w = static_cast<std::size_t>(wall);
  const auto* vertices = fluid.wall_vertices(w);
  if (!vertices) return {};
  const auto& rest = fluid.walls()[w].surface;
  const FacetTree<d> tree(*vertices, rest.facets);
  const auto points = fluid.points();
  std::vector<Vec<d>> all(points.begin(), points.end());
  std::vector<char> is_done(points.size(), 0);
  for (const auto& facet : fluid.boundary()) {
    if (facet.wall != wall) continue;
    for (const int n : facet.nodes) {
      const auto i = static_cast<std::size_t>(n);
      if (!is_done[i]) all[i] = anchor_on<d>(*vertices, rest.facets, tree, points[i]).interpolate(rest.vertices);
      is_done[i] = 1;
    }
  }
  return all;
}

}  // namespace splashdown::apps
