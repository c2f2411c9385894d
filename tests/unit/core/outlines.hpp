// Plane outlines that tests share.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/types.hpp"

namespace splashdown::outlines {

/// Closed, its corners in order.
inline Surface<2> polygon(const std::vector<Vec<2>>& corners) {
  Surface<2> outline;
  const auto n = static_cast<int>(corners.size());
  outline.vertices.resize(2, n);
  outline.facets.resize(2, n);
  for (int k = 0; k < n; ++k) {
    outline.vertices.col(k) = corners[static_cast<std::size_t>(k)];
    outline.facets.col(k) << k, (k + 1) % n;
  }
  return outline;
}
/// About the origin, as a polygon.
inline Surface<2> circle(double radius, int corners) {
  std::vector<Vec<2>> all;
  for (int k = 0; k < corners; ++k) {
    const double a = 2 * std::numbers::pi * k / corners;
    all.emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  return polygon(all);
}
/// About the origin.
inline Surface<2> box(double width, double height) {
  return polygon(
      {{-width / 2, -height / 2}, {width / 2, -height / 2}, {width / 2, height / 2}, {-width / 2, height / 2}});
}

}  // namespace splashdown::outlines
