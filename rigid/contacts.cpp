#include "rigid/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

namespace {

// Beyond this share of a body's size, and twice what the step moves it, nothing can touch within the step.
constexpr double near = 0.05;
// A corner may rest on a face if its edges leave the face, or dip by this slope at most.
constexpr double dip = 0.2;

/// A hull in the world.
template <int d>
struct Hull {
  Surface<d> surface;
  std::vector<std::vector<int>> neighbours;  // of vertices
  Vec<d> low, high;
  double size, moves;  // moves: farthest that its velocity takes a point of it within the step
};

template <int d>
Hull<d> hull_of(const BodySpec<d>& body, const BodyState<d>& state, double dt) {
  Hull<d> hull;
  hull.surface = body.surface;
  auto& x = hull.surface.vertices;
  x = (state.pose.linear() * body.surface.vertices).colwise() + state.pose.translation();
  hull.low = x.rowwise().minCoeff();
  hull.high = x.rowwise().maxCoeff();
  hull.size = (hull.high - hull.low).norm();
  hull.moves =
      dt * (state.velocity.template head<d>().norm() + hull.size * state.velocity.template tail<rotations<d>>().norm());
  hull.neighbours.resize(static_cast<std::size_t>(x.cols()));
  const auto& facets = body.surface.facets;
  for (Eigen::Index f = 0; f < facets.cols(); ++f)
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b)
        if (a != b) hull.neighbours[static_cast<std::size_t>(facets(a, f))].push_back(facets(b, f));
  return hull;
}

Vec<2> normal_of(const FacetCorners<2>& c) {
  const Vec<2> along = c[1] - c[0];
  return Vec<2>(along.y(), -along.x()).normalized();
}
Vec<3> normal_of(const FacetCorners<3>& c) { return (c[1] - c[0]).cross(c[2] - c[0]).normalized(); }

template <int d>
Vec<d> on_segment(const Vec<d>& x, const Vec<d>& a, const Vec<d>& b) {
  return a + std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) * (b - a);
}

Vec<2> nearest(const Vec<2>& x, const FacetCorners<2>& c) { return on_segment<2>(x, c[0], c[1]); }
Vec<3> nearest(const Vec<3>& x, const FacetCorners<3>& c) {
  const Vec<3> n = normal_of(c), foot = x - n.dot(x - c[0]) * n;
  bool inside = true;
  Vec<3> best = c[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec<3>&a = c[k], &b = c[(k + 1) % 3];
    inside = inside && n.dot((b - a).cross(foot - a)) >= 0;
    const Vec<3> on_edge = on_segment<3>(x, a, b);
    if ((x - on_edge).squaredNorm() < (x - best).squaredNorm()) best = on_edge;
  }
  return inside ? foot : best;
}

template <int d>
Wrench<d> about(const Vec<d>& centre, const Vec<d>& point, const Vec<d>& force) {
  const Vec<d> arm = point - centre;
  Wrench<d> wrench;
  if constexpr (d == 2)
    wrench << force, arm.x() * force.y() - arm.y() * force.x();
  else
    wrench << force, arm.cross(force);
  return wrench;
}

/// Whether vertex v, resting on a face with normal n, has its hull on the free side.
template <int d>
bool rests(const Hull<d>& hull, int v, const Vec<d>& n) {
  const auto& around = hull.neighbours[static_cast<std::size_t>(v)];
  return std::all_of(around.begin(), around.end(), [&](int w) {
    const Vec<d> edge = hull.surface.vertices.col(w) - hull.surface.vertices.col(v);
    return n.dot(edge) >= -dip * edge.norm();
  });
}

/// The nearest place of a hull on which a vertex of another one may rest: foot, normal and gap.
template <int d>
struct Place {
  Vec<d> foot, normal;
  double gap = std::numeric_limits<double>::infinity();
};

template <int d>
Place<d> place_for(const Hull<d>& moving, int v, const Hull<d>& touched) {
  struct Facet {
    Vec<d> foot, away, normal;
    double distance, height;  // height: over the facet's plane
  };
  const Vec<d> x = moving.surface.vertices.col(v);
  const double flush = 1e-9 * touched.size;
  std::vector<Facet> facets;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < touched.surface.facets.cols(); ++f) {
    const FacetCorners<d> corners = facet_corners(touched.surface, f);
    const Vec<d> foot = nearest(x, corners), away = x - foot, n = normal_of(corners);
    facets.push_back({foot, away, n, away.norm(), n.dot(away)});
    least = std::min(least, away.norm());
  }
  // At an edge or a corner the facets there decide together which side x is on.
  const auto inside = [&] {
    double side = 0;
    for (const Facet& f : facets)
      if (f.distance <= least + flush) side += f.height;
    return side < 0;
  }();
  Place<d> best;
  double nearest_yet = std::numeric_limits<double>::infinity();
  for (const Facet& f : facets) {
    if (f.distance >= nearest_yet) continue;
    const bool touches = f.distance <= flush, beside = !touches && std::abs(f.height) < (1 - 1e-9) * f.distance;
    if (!touches && (f.height < 0) != inside) continue;  // seen from behind
    if (beside && inside) continue;
    const Vec<d> n = beside ? Vec<d>(f.away / f.distance) : f.normal;
    if (!rests(moving, v, n)) continue;
    best = {f.foot, n, beside ? f.distance : f.height};
    nearest_yet = f.distance;
  }
  return best;
}

template <int d>
bool near_box(const Vec<d>& x, const Hull<d>& hull, double reach) {
  return ((x - hull.low).array() >= -reach).all() && ((hull.high - x).array() >= -reach).all();
}

}  // namespace

template <int d>
std::vector<Condition<d>> contacts_between(const ContactSpec<d>& spec, std::span<const BodySpec<d>> bodies,
                                           std::span<const BodyState<d>> states, double dt) {
  std::vector<Hull<d>> hulls;
  for (std::size_t i = 0; i < bodies.size(); ++i) hulls.push_back(hull_of(bodies[i], states[i], dt));
  const auto centre = [&](std::size_t i) -> Vec<d> { return states[i].pose.translation(); };
  std::vector<Condition<d>> all;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (a == b || (bodies[a].motion != Motion::free && bodies[b].motion != Motion::free)) continue;
      if (spec.apart.contains(std::minmax(a, b))) continue;
      const double reach = near * std::min(hulls[a].size, hulls[b].size) + 2 * (hulls[a].moves + hulls[b].moves);
      for (int v = 0; v < hulls[a].surface.vertices.cols(); ++v) {
        const Vec<d> x = hulls[a].surface.vertices.col(v);
        if (!near_box<d>(x, hulls[b], reach)) continue;
        const Place<d> place = place_for(hulls[a], v, hulls[b]);
        if (place.gap > reach) continue;
        all.push_back({a, b, about<d>(centre(a), x, place.normal), -about<d>(centre(b), place.foot, place.normal),
                       -place.gap / dt});
      }
    }
    if (bodies[a].motion != Motion::free) continue;
    for (const auto& plane : spec.planes)
      for (int v = 0; v < hulls[a].surface.vertices.cols(); ++v) {
        const Vec<d> x = hulls[a].surface.vertices.col(v);
        const double gap = plane.normal.dot(x - plane.point);
        if (gap > near * hulls[a].size + 2 * hulls[a].moves) continue;
        all.push_back({a, {}, about<d>(centre(a), x, plane.normal), Wrench<d>::Zero(), -gap / dt});
      }
  }
  return all;
}

template std::vector<Condition<2>> contacts_between(const ContactSpec<2>&, std::span<const BodySpec<2>>,
                                                    std::span<const BodyState<2>>, double);
template std::vector<Condition<3>> contacts_between(const ContactSpec<3>&, std::span<const BodySpec<3>>,
                                                    std::span<const BodyState<3>>, double);

}  // namespace splashdown::rigid
