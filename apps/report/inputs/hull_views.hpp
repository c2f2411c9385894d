// What the run was made of, drawn: hulls from the side, from ahead and from above in the frame of their shapes, with the water at rest.
//
// An outline is the edge of the facets that face the viewer: filled by the rule of non-zero winding it is their union, whatever the
// hull, and has as many corners as the silhouette, not as the mesh. Edges where facets meet at more than 30 degrees are thin lines.
#pragma once

#include <string>
#include <vector>

#include "apps/record/frames/vtu_grid.hpp"

namespace splashdown::apps {

/// A hull in the frame of its shape, moved to its centre of mass; z = 0 in two dimensions.
struct DrawnHull {
  std::vector<Point3> points;           ///< [m]
  std::vector<std::vector<int>> cells;  ///< triangles outward, or segments counter-clockwise
  bool plane = false;
  /// Plane of the water at rest, normal . x = offset, normal upwards; zero: not known.
  Point3 water_normal{0, 0, 0};
  double water_offset = 0;
};

/// Extent along x, y, z [m].
Point3 extent_of(const DrawnHull& hull);

/// <svg> elements with captions: one in the plane, three in space.
struct HullView {
  std::string svg, caption;  ///< HTML
};
std::vector<HullView> views_of(const DrawnHull& hull);

}  // namespace splashdown::apps
