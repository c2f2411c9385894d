#include "core/surface/wrap.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

#include "core/surface/soup.hpp"

namespace splashdown {
namespace {

constexpr double gap_share = 1. / 30;  // of the opening: CGAL's advice

using Triangles = std::vector<std::array<std::size_t, 3>>;

/// Polygons as fans.
Triangles triangles_of(const Soup& soup) {
  Triangles triangles;
  for (const auto& polygon : soup.polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k) triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  return triangles;
}

Shell wrap_at(const Soup& soup, const Triangles& triangles, double opening) {
  Shell mesh;
  CGAL::alpha_wrap_3(soup.points, triangles, opening, gap_share * opening, mesh);
  return mesh;
}

double volume_of(const Shell& mesh) { return std::abs(CGAL::Polygon_mesh_processing::volume(mesh)); }

}  // namespace

Wrap wrapped(const Soup& soup) {
  constexpr double finest = 0.01, coarsest = 0.05, coarser = 1.5, filled = 0.5;
  const auto triangles = triangles_of(soup);
  const double extent = soup.extent(), solid = filled * volume_of(wrap_at(soup, triangles, coarsest * extent));
  double share = finest;
  Shell mesh = wrap_at(soup, triangles, share * extent);
  while (share < coarsest && volume_of(mesh) < solid) mesh = wrap_at(soup, triangles, (share *= coarser) * extent);
  return {surface_of(soup_of(mesh)), share * extent, gap_share * share * extent};
}

}  // namespace splashdown
