// Closest points of segments and triangles, and where in them a point lies.
#pragma once

#include <algorithm>
#include <array>

#include "core/types.hpp"

namespace splashdown {

/// a + clamp((x - a) . e / |e|^2, 0, 1) e, e = b - a: closest point of a segment [m].
template <int d>
Vec<d> closest_on_segment(const Vec<d>& a, const Vec<d>& b, const Vec<d>& x) {
  const Vec<d> e = b - a;
  return a + std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e;
}

/// Closest point to x of a facet with corners `facet` [m]. In 2D: of a segment, which must have a length.
inline Vec<2> closest_on(const std::array<Vec<2>, 2>& facet, const Vec<2>& x) {
  return closest_on_segment<2>(facet[0], facet[1], x);
}
/// In 3D: the foot of x on the plane of a triangle, or the nearest point of the edges that x lies beyond.
Vec<3> closest_on(const std::array<Vec<3>, 3>& facet, const Vec<3>& x);

/// Of the foot of x on the line or plane of a facet: foot = facet[0] + sum_k w_k (facet[k] - facet[0]). By Gram and
/// Schmidt, written out: a general solver takes longer to compile than all that calls it. Edges without length have no
/// share.
inline Vec<1> weights_in(const std::array<Vec<2>, 2>& facet, const Vec<2>& x) {
  const Vec<2> e = facet[1] - facet[0];
  const double length2 = e.squaredNorm();
  return Vec<1>(length2 > 0 ? e.dot(x - facet[0]) / length2 : 0.0);
}
/// The same in 3D.
inline Vec<2> weights_in(const std::array<Vec<3>, 3>& facet, const Vec<3>& x) {
  const Vec<3> a = facet[1] - facet[0], b = facet[2] - facet[0], r = x - facet[0];
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  const double along = share(a.dot(b), a.squaredNorm()), first = share(a.dot(r), a.squaredNorm());
  const Vec<3> across = b - along * a;
  const double second = share(across.dot(r - first * a), across.squaredNorm());
  return {first - second * along, second};
}

}  // namespace splashdown
