#include "rigid/contact/touches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/closest_point.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

template <int d>
bool reaches_farthest(const Placed<d>& hull, int v, const Vec<d>& way) {
  const auto farther = [&](int a, int b) {
    const double at_a = way.dot(hull.x.col(a)), at_b = way.dot(hull.x.col(b));
    return at_a > at_b || (at_a == at_b && a < b);
  };
  return std::ranges::none_of(hull.hull->neighbours(v), [&](int w) { return farther(w, v); });
}

namespace {

// A corner may rest on a face if its edges leave the face, or dip by this slope at most.
constexpr double dip = 0.2;
// Of a hull's size: what positions do not resolve.
constexpr double flush = 1e-9;

/// A facet as a point sees it.
template <int d>
struct Seen {
  Vec<d> foot, away, normal;
  double distance, height;  // height: over the facet's plane
};

template <int d>
std::vector<Seen<d>> seen_from(const Vec<d>& x, const Placed<d>& hull, const std::vector<int>& facets) {
  std::vector<Seen<d>> all;
  all.reserve(facets.size());
  for (int f : facets) {
    const FacetCorners<d> corners = hull.corners(f);
    const Vec<d> foot = closest_on(corners, x), away = x - foot, n = area_vector(corners).normalized();
    all.push_back({foot, away, n, away.norm(), n.dot(away)});
  }
  return all;
}

/// At an edge or a corner the facets there decide together which side the point is on.
template <int d>
bool is_inside(const std::vector<Seen<d>>& facets, double resolution) {
  double least = std::numeric_limits<double>::infinity(), side = 0;
  for (const auto& f : facets) least = std::min(least, f.distance);
  for (const auto& f : facets)
    if (f.distance <= least + resolution) side += f.height;
  return side < 0;
}

/// What comes from another frame, and facets that are as near as others, are not missed.
template <int d>
std::vector<int> facets_within(const Placed<d>& hull, const Vec<d>& at, double distance) {
  return hull.hull->facets_near(at, distance + 4 * flush * hull.size);
}

template <int d>
bool contains(const Placed<d>& hull, const Vec<d>& x) {
  const Vec<d> at = hull.seen(x);
  return is_inside(
      seen_from(x, hull, facets_within(hull, at, hull.hull->distance(at, std::numeric_limits<double>::infinity()))),
      flush * hull.size);
}

/// Whether vertex v, resting on a face with normal n, has its hull on the free side.
template <int d>
bool rests(const Placed<d>& hull, int v, const Vec<d>& n) {
  const auto& around = hull.hull->neighbours(v);
  return std::all_of(around.begin(), around.end(), [&](int w) {
    const Vec<d> edge = hull.x.col(w) - hull.x.col(v);
    return n.dot(edge) >= -dip * edge.norm();
  });
}

/// The nearest of these facets on which the vertex may rest.
template <int d>
std::optional<Touch<d>> nearest_rest(const Placed<d>& moving, int v, const std::vector<Seen<d>>& facets, bool inside,
                                     double resolution) {
  std::optional<Touch<d>> best;
  double nearest_yet = std::numeric_limits<double>::infinity();
  for (const auto& f : facets) {
    if (f.distance >= nearest_yet) continue;
    const bool touches = f.distance <= resolution, beside = !touches && std::abs(f.height) < (1 - 1e-9) * f.distance;
    if (!touches && (f.height < 0) != inside) continue;  // seen from behind
    if (beside && inside) continue;
    const Vec<d> n = beside ? Vec<d>(f.away / f.distance) : f.normal;
    if (!rests(moving, v, n)) continue;
    best = {moving.x.col(v), f.foot, n, beside ? f.distance : f.height};
    nearest_yet = f.distance;
  }
  return best;
}

/// Of a vertex from a hull; infinity beyond reach, unless it may be inside.
template <int d>
double distance(const Placed<d>& hull, const Vec<d>& x, double reach) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const double near_by = hull.hull->distance(hull.seen(x), reach + flush * hull.size);
  return near_by == any && hull.has_near(x, 0) ? hull.hull->distance(hull.seen(x), any) : near_by;
}

/// The nearest place of a hull on which a vertex of another one, `least` from it, may rest. One that is inside may have to leave by a
/// far facet; what is outside of a convex hull sees one place only.
template <int d>
std::optional<Touch<d>> touch_of_vertex(const Placed<d>& moving, int v, const Placed<d>& touched, double least,
                                        double reach) {
  const Vec<d> x = moving.x.col(v), at = touched.seen(x);
  const double resolution = flush * touched.size;
  const auto nearest = seen_from(x, touched, facets_within(touched, at, least));
  const bool inside = is_inside(nearest, resolution);
  if (!inside && least > reach + resolution) return {};
  auto best = nearest_rest(moving, v, nearest, inside, resolution);
  if (best && best->distance() > least + resolution) best.reset();  // there may be a nearer one
  if (!best && (inside || !touched.hull->is_convex()))
    best = nearest_rest(moving, v,
                        seen_from(x, touched, inside ? touched.hull->all_facets() : facets_within(touched, at, reach)),
                        inside, resolution);
  return best && best->gap <= reach ? best : std::nullopt;
}

/// What a vertex on a curve stands for touches with the curve, not with the vertex: a polygon would lose energy at each corner that
/// it rolls over. Nothing if its centre is inside of what it touches.
template <int d>
std::optional<Touch<d>> touch_of_curve(const Placed<d>& moving, int v, const Placed<d>& touched, double reach) {
  const auto& round = moving.hull->round(v);
  const Vec<d> centre = moving.pose * round.centre;
  const double resolution = flush * touched.size, least = distance(touched, centre, reach + round.radius);
  std::optional<Touch<d>> best;
  if (!std::isfinite(least)) return best;
  for (const auto& f : seen_from(centre, touched, facets_within(touched, touched.seen(centre), reach + round.radius))) {
    const bool beside = std::abs(f.height) < (1 - 1e-9) * f.distance;
    if (f.height < 0 || (beside && f.distance > least + resolution)) continue;
    const Vec<d> n = f.away / f.distance;
    const double gap = f.distance - round.radius;
    if (gap > reach || (best && best->gap <= gap) || !reaches_farthest<d>(moving, v, -n)) continue;
    best = {centre - round.radius * n, f.foot, n, gap};
  }
  return best;
}

/// Of two convex edges that cross: where their lines are nearest, if that is between the ends of both and each solid lies on its
/// own side of the plane through both directions. Ends are vertices, which look for themselves.
std::optional<Touch<3>> touch_of_edges(const Placed<3>& a, const Edge& on_a, const Placed<3>& b, const Edge& on_b) {
  constexpr double parallel = 1e-3;  // sine
  const double end = 1e-6 * std::min(a.size, b.size);
  const Vec<3> p0 = a.x.col(on_a.vertices[0]), u = a.x.col(on_a.vertices[1]) - p0;
  const Vec<3> q0 = b.x.col(on_b.vertices[0]), w = b.x.col(on_b.vertices[1]) - q0;
  Vec<3> n = u.cross(w);
  const double squared = n.squaredNorm(), length_a = u.norm(), length_b = w.norm();
  if (std::sqrt(squared) <= parallel * length_a * length_b) return {};
  const double s = (q0 - p0).cross(w).dot(n) / squared, t = (q0 - p0).cross(u).dot(n) / squared;
  if (std::min(s, 1 - s) * length_a <= end || std::min(t, 1 - t) * length_b <= end) return {};
  n /= std::sqrt(squared);
  const Eigen::Matrix3d &A = a.pose.linear(), &B = b.pose.linear();
  if (n.dot(B * on_b.out) < 0) n = -n;
  bool apart = n.dot(A * on_a.out) < 0;
  for (const auto& into : on_a.into) apart = apart && n.dot(A * into) >= -dip;
  for (const auto& into : on_b.into) apart = apart && n.dot(B * into) <= dip;
  if (!apart) return {};
  const Vec<3> p = p0 + s * u, q = q0 + t * w;
  return Touch<3>{p, q, n, n.dot(p - q)};
}

/// Where what crosses an edge of `a` within reach may be, as `b` sees it: on the normals that the edge can be touched along.
Eigen::AlignedBox3d crossed_by(const Edge& edge, const Placed<3>& a, const Placed<3>& b, double reach) {
  constexpr double beside = dip + 0.04;  // of their length: normals of edges that dip, and the arc between two of them
  Eigen::AlignedBox3d box;
  for (int v : edge.vertices) box.extend(b.seen(a.x.col(v)));
  const Eigen::AlignedBox3d segment = box;
  const Eigen::Matrix3d turn = b.pose.linear().transpose() * a.pose.linear();
  for (const auto& normal : edge.normals)
    for (double way : {-reach, reach}) {
      box.extend(segment.min() + way * turn * normal);
      box.extend(segment.max() + way * turn * normal);
    }
  box.min().array() -= beside * reach;
  box.max().array() += beside * reach;
  return box;
}

}  // namespace

template <int d>
std::vector<Touch<d>> touches_of_vertices(const Placed<d>& a, const Placed<d>& b, double reach) {
  std::vector<Touch<d>> all;
  for (int v = 0; v < a.x.cols(); ++v) {
    if (!b.has_near(a.x.col(v), reach)) continue;
    const double least = distance<d>(b, a.x.col(v), reach);
    if (!std::isfinite(least)) continue;
    const auto& round = a.hull->round(v);
    const auto touch = round.radius > 0 && !contains<d>(b, a.pose * round.centre)
                           ? touch_of_curve(a, v, b, reach)
                           : touch_of_vertex(a, v, b, least, reach);
    if (touch) all.push_back(*touch);
  }
  return all;
}

std::vector<Touch<3>> touches_of_edges(const Placed<3>& a, const Placed<3>& b, double reach) {
  std::vector<Touch<3>> all;
  const double met = 100 * flush * std::min(a.size, b.size);  // what closed contacts leave between positions
  for (const Edge& edge : a.hull->edges()) {
    const Vec<3> from = a.x.col(edge.vertices[0]), to = a.x.col(edge.vertices[1]);
    if (!((from.cwiseMax(to) - b.low).array() >= -reach).all() ||
        !((b.high - from.cwiseMin(to)).array() >= -reach).all())
      continue;
    const double half = 0.5 * (to - from).norm();
    if (!std::isfinite(distance<3>(b, 0.5 * (from + to), reach + half))) continue;
    for (int other : b.hull->edges_within(crossed_by(edge, a, b, reach))) {
      const auto touch = touch_of_edges(a, edge, b, b.hull->edges()[static_cast<std::size_t>(other)]);
      if (!touch || touch->gap > reach) continue;
      if (touch->gap < -met && !(contains(b, touch->point) && contains(a, touch->foot))) continue;
      all.push_back(*touch);
    }
  }
  return all;
}

template bool reaches_farthest(const Placed<2>&, int, const Vec<2>&);
template bool reaches_farthest(const Placed<3>&, int, const Vec<3>&);
template std::vector<Touch<2>> touches_of_vertices(const Placed<2>&, const Placed<2>&, double);
template std::vector<Touch<3>> touches_of_vertices(const Placed<3>&, const Placed<3>&, double);

}  // namespace splashdown::rigid
