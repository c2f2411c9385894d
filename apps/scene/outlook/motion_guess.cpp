#include "apps/scene/outlook/motion_guess.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/scene/scales.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;
using std::numbers::pi;

Point along_path(const Body& body, double time) {
  const auto& path = body.path;
  const auto next = std::ranges::upper_bound(path, time, {}, &Waypoint::time);
  if (next == path.end()) return path.back().position - path.front().position;
  if (next == path.begin()) return Point::Zero();
  const auto& from = *(next - 1);
  const double share = (time - from.time) / (next->time - from.time);
  return from.position + share * (next->position - from.position) - path.front().position;
}

bool moves_along(const Body& body, int axis) {
  const auto names = freedom_names(3);
  return std::ranges::find(body.free, names[static_cast<std::size_t>(axis)]) != body.free.end();
}

/// `start`: of the body, or of one that moves on from where it is let go.
template <int d>
Vec<d> free_motion(const Scene& scene, const Body& body, const GuessedBody<d>& start, const Extents<d>& box,
                   double time) {
  Vec<d> velocity = vec<d>(body.velocity), gravity = Vec<d>::Zero();
  if (scene.gravity) gravity = vec<d>(scene.gravity->acceleration);
  for (int k = 0; k < d; ++k)
    if (!moves_along(body, k)) velocity[k] = gravity[k] = 0;
  const auto level = still_water_level<d>(scene);
  if (!level) return velocity * time + 0.5 * time * time * gravity;
  const double fall = std::max(0., box.min()[d - 1] - *level), g = std::max(0., -gravity[d - 1]);
  const double down = -velocity[d - 1], reach = std::sqrt(std::max(0., down * down + 2 * g * fall));
  const double arrival = fall == 0 ? 0 : g > 0 ? (reach - down) / g : down > 0 ? fall / down : time;
  const double in_air = std::min(time, arrival), in_water = std::max(0., time - arrival);
  Vec<d> moved = velocity * in_air + 0.5 * in_air * in_air * gravity;
  const double total = start.mass + start.impact_mass, share = total > 0 ? start.mass / total : 0;
  moved += share * (velocity + gravity * in_air) * in_water;
  moved[d - 1] = std::max(moved[d - 1], std::min(0., *level - box.max()[d - 1]));
  return moved;
}

/// What is below a height.
template <int d>
Extents<d> below_height(const rigid::Surface<d>& hull, double height) {
  Extents<d> below;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f)
    for (int k = 0; k < d; ++k) {
      const Vec<d> a = hull.vertices.col(hull.facets(k, f)), b = hull.vertices.col(hull.facets((k + 1) % d, f));
      if (a[d - 1] <= height) below.extend(a);
      if ((a[d - 1] <= height) != (b[d - 1] <= height))
        below.extend(Vec<d>(a + (height - a[d - 1]) / (b[d - 1] - a[d - 1]) * (b - a)));
    }
  return below;
}

/// What will be under water at a time, with the water that rises beside a wedge.
template <int d>
Extents<d> wetted_part(const Scene& scene, const GuessedBody<d>& body, const Vec<d>& moved, double time) {
  const auto level = still_water_level<d>(scene);
  if (!level) return {};
  auto hull = body.hull;
  hull.vertices.colwise() += moved;
  const double depth = std::max(0., *level - extents<d>(hull).min()[d - 1]);
  return below_height<d>(hull, *level + (time > 0 ? (pi / 2 - 1) * depth : 0));
}

}  // namespace

template <int d>
GuessedBody<d> guessed_body(const Scene& scene, const Body& body) {
  GuessedBody<d> guessed{&body, outline<d>(body), 0, 0};
  guessed.mass = body.mass      ? *body.mass
                 : body.density ? *body.density * shape_of<d>(body.shape).at_unit_density.mass
                                : 0;
  guessed.impact_mass = scene.fluid ? impact_mass(scene.fluid->density, guessed.hull) : 0;
  return guessed;
}

template <int d>
double wetted_half(const Scene& scene, const Body& of, double time) {
  const auto body = guessed_body<d>(scene, of);
  const auto wet = wetted_part<d>(scene, body, guessed_motion<d>(scene, body, time), time);
  return wet.isEmpty() ? 0 : wet.sizes().template head<d - 1>().maxCoeff() / 2;
}

template <int d>
std::optional<WettedEnds<d>> wetted_ends(const Scene& scene, const GuessedBody<d>& body, double time) {
  const Vec<d> moved = guessed_motion<d>(scene, body, time);
  const auto wet = wetted_part<d>(scene, body, moved, time);
  if (wet.isEmpty()) return {};
  WettedEnds<d> ends;
  ends << wet.min().template head<d - 1>() - moved.template head<d - 1>(),
      wet.max().template head<d - 1>() - moved.template head<d - 1>();
  return ends;
}

template <>
std::optional<double> jet_thickness<2>(const Body& body, double half) {
  constexpr double least_deadrise = 3 * radians;
  const auto angle = deadrise<2>(body);
  if (!angle || *angle < least_deadrise) return {};
  return std::pow(std::tan(*angle), 2) / (2 * pi) * half;
}
template <>
std::optional<double> jet_thickness<3>(const Body&, double) {
  return {};
}

double impact_mass(double density, const rigid::Surface<2>& hull) {
  const double breadth = extents<2>(hull).sizes().x();
  return density * pi / 8 * breadth * breadth;
}

double impact_mass(double density, const rigid::Surface<3>& hull) {
  double upward = 0;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f) {
    const Vec<3> a = hull.vertices.col(hull.facets(0, f)), b = hull.vertices.col(hull.facets(1, f)),
                 c = hull.vertices.col(hull.facets(2, f));
    upward += std::abs((b - a).cross(c - a).z()) / 2;
  }
  const double radius = std::sqrt(upward / 2 / pi);  // of a disc with the area seen from above
  return density * 4. / 3 * radius * radius * radius;
}

bool is_let_go(const Body& body, double time) {
  return body.release && body.release->time && time > *body.release->time;
}

/// On its path until it is released at a time, and free from there.
template <int d>
Vec<d> carried_and_let_go(const Scene& scene, const GuessedBody<d>& guessed, double time) {
  const Body& body = *guessed.body;
  const double carried = *body.release->time, instant = 1e-6 * carried;
  Body free = body;
  free.motion = Motion::free;
  free.path.clear();
  free.release.reset();
  const Point moved = body.path.empty() ? Point(body.velocity * carried) : along_path(body, carried);
  if (!body.path.empty()) free.velocity = (moved - along_path(body, carried - instant)) / instant;
  auto box = extents<d>(guessed.hull);
  box.translate(vec<d>(moved));
  return vec<d>(moved) + free_motion<d>(scene, free, guessed, box, time - carried);
}

template <int d>
Vec<d> guessed_motion(const Scene& scene, const GuessedBody<d>& guessed, double time) {
  const Body& body = *guessed.body;
  if (body.motion == Motion::fixed || time == 0) return Vec<d>::Zero();
  const auto box = extents<d>(guessed.hull);
  Vec<d> moved = is_let_go(body, time)               ? carried_and_let_go<d>(scene, guessed, time)
                 : !body.path.empty()                ? vec<d>(along_path(body, time))
                 : body.motion == Motion::prescribed ? Vec<d>(vec<d>(body.velocity) * time)
                                                     : free_motion<d>(scene, body, guessed, box, time);
  if (!scene.tank) return moved;
  const auto tank = extents<d>(*scene.tank);
  for (int k = 0; k < d; ++k)
    moved[k] =
        std::clamp(moved[k], std::min(0., tank.min()[k] - box.min()[k]), std::max(0., tank.max()[k] - box.max()[k]));
  return moved;
}

template <int d>
Vec<d> guessed_motion(const Scene& scene, const Body& body, double time) {
  return guessed_motion<d>(scene, guessed_body<d>(scene, body), time);
}

template GuessedBody<2> guessed_body<2>(const Scene&, const Body&);
template GuessedBody<3> guessed_body<3>(const Scene&, const Body&);
template Vec<2> guessed_motion<2>(const Scene&, const GuessedBody<2>&, double);
template Vec<3> guessed_motion<3>(const Scene&, const GuessedBody<3>&, double);
template double wetted_half<2>(const Scene&, const Body&, double);
template double wetted_half<3>(const Scene&, const Body&, double);
template std::optional<WettedEnds<2>> wetted_ends<2>(const Scene&, const GuessedBody<2>&, double);
template std::optional<WettedEnds<3>> wetted_ends<3>(const Scene&, const GuessedBody<3>&, double);
template Vec<2> guessed_motion<2>(const Scene&, const Body&, double);
template Vec<3> guessed_motion<3>(const Scene&, const Body&, double);

}  // namespace splashdown::apps
