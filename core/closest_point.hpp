// Closest points of segments and triangles.
#pragma once

#include <algorithm>
#include <array>

#include "core/types.hpp"

namespace splashdown {

template <int d>
Vec<d> closest_on_segment(const Vec<d>& a, const Vec<d>& b, const Vec<d>& x) {
  const Vec<d> e = b - a;
  return a + std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e;
}

/// Closest point of a facet.
inline Vec<2> closest_on(const std::array<Vec<2>, 2>& facet, const Vec<2>& x) {
  return closest_on_segment<2>(facet[0], facet[1], x);
}
Vec<3> closest_on(const std::array<Vec<3>, 3>& facet, const Vec<3>& x);

}  // namespace splashdown
