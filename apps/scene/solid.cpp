#include "apps/scene/solid.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/closest_point.hpp"

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;

template <int d>
using Corners = std::array<Vec<d>, static_cast<std::size_t>(d)>;

template <int d>
Corners<d> corners_of(const Surface<d>& surface, Eigen::Index facet) {
  Corners<d> corners;
  for (int k = 0; k < d; ++k) corners[static_cast<std::size_t>(k)] = surface.vertices.col(surface.facets(k, facet));
  return corners;
}

template <int d>
InsideTest<d> inside_test(const Surface<d>& surface) {
  std::vector<Vec<d>> points;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) points.emplace_back(surface.vertices.col(i));
  std::vector<Facet<d>> facets(static_cast<std::size_t>(surface.facets.cols()));
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (int k = 0; k < d; ++k)
      facets[i].nodes[static_cast<std::size_t>(k)] = surface.facets(k, static_cast<Eigen::Index>(i));
  return {points, facets};
}

Vec<2> normal_of(const Corners<2>& c) { return Vec<2>(c[1].y() - c[0].y(), c[0].x() - c[1].x()).normalized(); }
Vec<3> normal_of(const Corners<3>& c) { return (c[1] - c[0]).cross(c[2] - c[0]).normalized(); }

/// Where a line from a to b (0 to 1) meets the surface, with 0 and 1 themselves, in order.
template <int d>
std::vector<double> crossings(const Vec<d>& a, const Vec<d>& b, const Solid<d>& solid, double tolerance) {
  std::vector<double> at{0, 1};
  for (const int f : solid.facets_near({a.cwiseMin(b), a.cwiseMax(b)})) {
    const auto corners = corners_of(solid.surface(), f);
    const Vec<d> n = normal_of(corners);
    const double from = n.dot(a - corners[0]), to = n.dot(b - corners[0]);
    if ((from > 0) == (to > 0)) continue;
    const double share = from / (from - to);
    const Vec<d> x = a + share * (b - a);
    if ((closest_on(corners, x) - x).norm() <= tolerance) at.push_back(share);
  }
  std::sort(at.begin(), at.end());
  return at;
}

/// Some piece of the edge lies inside the solid.
template <int d>
bool enters(const Vec<d>& from, const Vec<d>& to, const Solid<d>& solid, double tolerance) {
  if (!solid.extents().intersects(Extents<d>(from.cwiseMin(to), from.cwiseMax(to)))) return false;
  const auto at = crossings<d>(from, to, solid, tolerance);
  for (std::size_t i = 1; i < at.size(); ++i)
    for (const double share : {at[i - 1], 0.5 * (at[i - 1] + at[i])})
      if (solid.contains(from + share * (to - from), tolerance)) return true;
  return false;
}

/// Some piece of an edge of `a` lies inside `b`.
template <int d>
bool reaches_into(const Solid<d>& a, const Solid<d>& b, double tolerance) {
  const auto& surface = a.surface();
  const int edges = d == 2 ? 1 : 3;  // of a facet
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    for (int k = 0; k < edges; ++k) {
      const int from = surface.facets(k, f), to = surface.facets((k + 1) % d, f);
      if (d == 3 && from > to) continue;  // of the facet on its other side, where it runs the other way
      if (enters<d>(surface.vertices.col(from), surface.vertices.col(to), b, tolerance)) return true;
    }
  return false;
}

}  // namespace

template <int d>
Solid<d>::Solid(const Surface<d>& surface) : surface_(surface), box_(apps::extents<d>(surface)) {}

template <int d>
const typename Solid<d>::Search& Solid<d>::search() const {
  if (!search_) search_ = Search{{surface_.vertices, surface_.facets}, inside_test<d>(surface_)};
  return *search_;
}

template <int d>
double Solid<d>::distance(const Vec<d>& point) const {
  return (search().facets.nearest(point, std::numeric_limits<double>::max()).point - point).norm();
}

template <int d>
double Solid<d>::signed_distance(const Vec<d>& point) const {
  return search().inside(point) ? -distance(point) : distance(point);
}

template <int d>
bool Solid<d>::contains(const Vec<d>& point, double depth) const {
  return contains(point) && search().facets.nearest(point, depth).facet < 0;
}

template <int d>
std::vector<int> Solid<d>::facets_near(const Extents<d>& box) const {
  return search().facets.meeting(box);
}

template <int d>
bool overlap(const Solid<d>& a, const Solid<d>& b, double depth) {
  const double tolerance = 1e-9 * (a.extents().diagonal().norm() + b.extents().diagonal().norm());
  if (!a.extents().intersects(b.extents())) return false;
  // Two surfaces that coincide: no edge enters the other.
  if ((a.extents().center() - b.extents().center()).norm() < tolerance &&
      (a.extents().sizes() - b.extents().sizes()).norm() < tolerance)
    return true;
  const double least = std::max(tolerance, depth);
  return reaches_into(a, b, least) || reaches_into(b, a, least);
}

template class Solid<2>;
template class Solid<3>;
template bool overlap<2>(const Solid<2>&, const Solid<2>&, double);
template bool overlap<3>(const Solid<3>&, const Solid<3>&, double);

}  // namespace splashdown::apps
