// A wall as the fluid meets it.
#pragma once

#include <span>

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

}  // namespace splashdown::apps
