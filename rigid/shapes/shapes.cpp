#include "rigid/shapes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rigid/message.hpp"
#include "rigid/shapes/require.hpp"

namespace splashdown::rigid {

namespace {

using Points = std::vector<Vec<2>>;
using std::numbers::pi;

std::string text(const Vec<2>& p) { return message("(", p.x(), ", ", p.y(), ")"); }

void require_segments(const char* shape, int segments) {
  const int fewest = 8;  // an octagon is the coarsest thing that may be called round
  if (segments < fewest) throw std::invalid_argument(message(shape, ": ", segments, " segments; at least ", fewest));
}

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance(const Vec<2>& p, const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> edge = b - a;
  const double along = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0., 1.);
  return (p - a - along * edge).norm();
}

/// Edges touch or cross: either one passes between the other's ends, or an end lies on the other edge.
bool meet(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& e, double tolerance) {
  const bool apart = (a.cwiseMax(b).array() + tolerance < c.cwiseMin(e).array()).any() ||
                     (c.cwiseMax(e).array() + tolerance < a.cwiseMin(b).array()).any();
  if (apart) return false;
  if (cross(b - a, c - a) * cross(b - a, e - a) < 0 && cross(e - c, a - c) * cross(e - c, b - c) < 0) return true;
  return std::min({distance(a, c, e), distance(b, c, e), distance(c, a, b), distance(e, a, b)}) <= tolerance;
}

struct Range {
  double low, high;
};
using Pair = std::pair<std::size_t, std::size_t>;

/// The first pair i < j, in the order of i and then j, whose ranges come as near as `tolerance` and that is
/// `refused`. Sorted by their lower ends only those are compared that share a stretch: n log n for outlines.
template <class Refused>
std::optional<Pair> first_pair(std::span<const Range> ranges, double tolerance, Refused refused) {
  std::vector<std::size_t> order(ranges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return ranges[i].low; });
  std::optional<Pair> first;
  for (auto a = order.begin(); a != order.end(); ++a)
    for (auto b = a + 1; b != order.end() && ranges[*b].low <= ranges[*a].high + tolerance; ++b)
      if (const Pair pair = std::minmax(*a, *b); (!first || pair < *first) && refused(pair.first, pair.second))
        first = pair;
  return first;
}

/// Of the points' coordinates along the axis in which they are spread more.
std::vector<Range> ranges_of(std::span<const Vec<2>> points, bool edges) {
  Vec<2> low = points[0], high = points[0];
  for (const auto& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const int axis = high.x() - low.x() > high.y() - low.y() ? 0 : 1;
  std::vector<Range> ranges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double from = points[i][axis], to = edges ? points[(i + 1) % points.size()][axis] : from;
    ranges.push_back({std::min(from, to), std::max(from, to)});
  }
  return ranges;
}

void require_simple(std::span<const Vec<2>> points, double tolerance) {
  const std::size_t n = points.size();
  const auto end = [&](std::size_t edge) -> const Vec<2>& { return points[(edge + 1) % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (distance(end(next), points[i], end(i)) <= tolerance ||
        distance(points[i], points[next], end(next)) <= tolerance)
      throw std::invalid_argument(
          message("polygon: the outline folds back onto itself at point ", next + 1, " ", text(points[next])));
  }
  const auto ranges = ranges_of(points, true);
  const auto pair = first_pair(ranges, tolerance, [&](std::size_t i, std::size_t j) {
    const bool neighbours = j == i + 1 || (j + 1) % n == i;
    return !neighbours && meet(points[i], end(i), points[j], end(j), tolerance);
  });
  if (!pair) return;
  const auto [i, j] = *pair;
  throw std::invalid_argument(message("polygon: edges ", i + 1, " ", text(points[i]), "-", text(end(i)), " and ", j + 1,
                                      " ", text(points[j]), "-", text(end(j)),
                                      " touch or cross; an outline must not meet itself"));
}

void require_distinct(std::span<const Vec<2>> points, double tolerance) {
  const auto ranges = ranges_of(points, false);
  const auto pair = first_pair(
      ranges, tolerance, [&](std::size_t i, std::size_t j) { return (points[i] - points[j]).norm() <= tolerance; });
  if (!pair) return;
  throw std::invalid_argument(message("polygon: points ", pair->first + 1, " and ", pair->second + 1, " are the same, ",
                                      text(points[pair->first]),
                                      "; the outline closes by itself and repeats no point"));
}

}  // namespace

double signed_area(std::span<const Vec<2>> points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    twice += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  return twice / 2;
}

Surface<2> closed_polyline(std::span<const Vec<2>> points) {
  const auto n = static_cast<int>(points.size());
  Surface<2> s;
  s.vertices.resize(2, n);
  s.facets.resize(2, n);
  for (int i = 0; i < n; ++i) {
    s.vertices.col(i) = points[static_cast<std::size_t>(i)];
    s.facets.col(i) << i, (i + 1) % n;
  }
  return s;
}

Shape<2> polygon(std::span<const Vec<2>> points) {
  if (points.size() < 3)
    throw std::invalid_argument(message("polygon: ", points.size(), " points; an outline needs at least 3"));
  Vec<2> low = points[0], high = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw std::invalid_argument(message("polygon: point ", i + 1, " ", text(points[i]), " is not finite"));
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  // Nearer than this is touching: finer than any scene file or element, coarser than round-off.
  const double extent = (high - low).norm(), tolerance = 1e-9 * extent;
  require_distinct(points, tolerance);
  const double area = signed_area(points);
  if (std::abs(area) <= tolerance * extent)
    throw std::invalid_argument(
        message("polygon: the outline encloses an area of ", std::abs(area), " m^2; it must not be zero"));
  require_simple(points, tolerance);

  Points ordered(points.begin(), points.end());
  if (area < 0) std::reverse(ordered.begin() + 1, ordered.end());
  const Surface<2> surface = closed_polyline(ordered);
  return {surface, mass_properties(surface)};
}

Shape<2> wedge(double deadrise, double breadth, double side) {
  if (!(deadrise > 0 && deadrise < pi / 2))
    throw std::invalid_argument(message("wedge: deadrise is ", deadrise * 180 / pi,
                                        " degrees; it must lie between 0 and 90 (a flat bottom is a box)"));
  require_positive("wedge", "breadth", breadth);
  if (!(side >= 0 && std::isfinite(side)))
    throw std::invalid_argument(message("wedge: side height is ", side, "; it must not be negative"));
  const double half = breadth / 2, chine = half * std::tan(deadrise);
  Points points{{0, 0}, {half, chine}};
  if (side > 0) points.insert(points.end(), {{half, chine + side}, {-half, chine + side}});
  points.push_back({-half, chine});
  return {closed_polyline(points), wedge_mass_properties(deadrise, breadth, side)};
}

Shape<2> box(double width, double height) {
  require_positive("box", "width", width);
  require_positive("box", "height", height);
  const double x = width / 2, y = height / 2;
  const Points points{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  return {closed_polyline(points), box_mass_properties(width, height)};
}

Shape<2> circle(double radius, int segments) {
  require_positive("circle", "radius", radius);
  return ellipse(radius, radius, segments);
}

Shape<2> ellipse(double a, double b, int segments) {
  require_positive("ellipse", "semi-axis a", a);
  require_positive("ellipse", "semi-axis b", b);
  require_segments("ellipse", segments);
  Points points;
  for (int i = 0; i < segments; ++i) {
    const double t = 2 * pi * i / segments;
    points.push_back({a * std::cos(t), b * std::sin(t)});
  }
  return {closed_polyline(points), ellipse_mass_properties(a, b)};
}

Shape<2> capsule(double radius, double straight, int segments) {
  require_positive("capsule", "radius", radius);
  require_positive("capsule", "straight length", straight);
  require_segments("capsule", segments);
  if (segments % 2 != 0)
    throw std::invalid_argument(message("capsule: ", segments, " segments; the number must be even"));
  const int half = segments / 2;
  Points points;
  for (const double side : {1., -1.}) {
    for (int i = 0; i <= half; ++i) {
      const double t = pi * i / half - pi / 2;
      points.push_back({side * (straight / 2 + radius * std::cos(t)), side * radius * std::sin(t)});
    }
  }
  return {closed_polyline(points), capsule_mass_properties(radius, straight)};
}

template <int d>
Surface<d> centred(Surface<d> surface, const Vec<d>& centre) {
  surface.vertices.colwise() -= centre;
  return surface;
}

template Surface<2> centred<2>(Surface<2>, const Vec<2>&);
template Surface<3> centred<3>(Surface<3>, const Vec<3>&);

}  // namespace splashdown::rigid
