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

double mass_of(const Body& body, double volume) {
  if (body.mass) return *body.mass;
  return body.density.value_or(0) * volume;
}

template <int d>
Vec<d> free_motion(const Scene& scene, const Body& body, const rigid::Surface<d>& hull, double time) {
  Vec<d> velocity = vec<d>(body.velocity), gravity = Vec<d>::Zero();
  if (scene.gravity) gravity = vec<d>(scene.gravity->acceleration);
  for (int k = 0; k < d; ++k)
    if (!moves_along(body, k)) velocity[k] = gravity[k] = 0;
  const auto level = still_water_level<d>(scene);
  if (!level) return velocity * time + 0.5 * time * time * gravity;
  const auto box = extents<d>(hull);
  const double fall = std::max(0., box.min()[d - 1] - *level), g = std::max(0., -gravity[d - 1]);
  const double down = -velocity[d - 1], reach = std::sqrt(std::max(0., down * down + 2 * g * fall));
  const double arrival = fall == 0 ? 0 : g > 0 ? (reach - down) / g : down > 0 ? fall / down : time;
  const double in_air = std::min(time, arrival), in_water = std::max(0., time - arrival);
  Vec<d> moved = velocity * in_air + 0.5 * in_air * in_air * gravity;
  const double mass = mass_of(body, shape_of<d>(body.shape).at_unit_density.mass);
  const double total = mass + impact_mass(scene.fluid->density, hull), share = total > 0 ? mass / total : 0;
  moved += share * (velocity + gravity * in_air) * in_water;
  moved[d - 1] = std::max(moved[d - 1], std::min(0., *level - box.max()[d - 1]));
  return moved;
}

/// Half the longer horizontal extent of what is below a height.
template <int d>
double half_breadth(const rigid::Surface<d>& hull, double height) {
  Extents<d> below;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f)
    for (int k = 0; k < d; ++k) {
      const Vec<d> a = hull.vertices.col(hull.facets(k, f)), b = hull.vertices.col(hull.facets((k + 1) % d, f));
      if (a[d - 1] <= height) below.extend(a);
      if ((a[d - 1] <= height) != (b[d - 1] <= height))
        below.extend(Vec<d>(a + (height - a[d - 1]) / (b[d - 1] - a[d - 1]) * (b - a)));
    }
  return below.isEmpty() ? 0 : below.sizes().template head<d - 1>().maxCoeff() / 2;
}

}  // namespace

template <int d>
double wetted_half(const Scene& scene, const Body& body, double time) {
  const auto level = still_water_level<d>(scene);
  if (!level) return 0;
  auto hull = outline<d>(body);
  hull.vertices.colwise() += guessed_motion<d>(scene, body, time);
  const double depth = std::max(0., *level - extents<d>(hull).min()[d - 1]);
  return half_breadth<d>(hull, *level + (time > 0 ? (pi / 2 - 1) * depth : 0));
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
Vec<d> carried_and_let_go(const Scene& scene, const Body& body, double time) {
  const double carried = *body.release->time, instant = 1e-6 * carried;
  Body free = body;
  free.motion = Motion::free;
  free.path.clear();
  free.release.reset();
  const Point moved = body.path.empty() ? Point(body.velocity * carried) : along_path(body, carried);
  if (!body.path.empty()) free.velocity = (moved - along_path(body, carried - instant)) / instant;
  free.position += moved;
  return vec<d>(moved) + free_motion<d>(scene, free, outline<d>(free), time - carried);
}

template <int d>
Vec<d> guessed_motion(const Scene& scene, const Body& body, double time) {
  if (body.motion == Motion::fixed || time == 0) return Vec<d>::Zero();
  const auto hull = outline<d>(body);
  Vec<d> moved = is_let_go(body, time)               ? carried_and_let_go<d>(scene, body, time)
                 : !body.path.empty()                ? vec<d>(along_path(body, time))
                 : body.motion == Motion::prescribed ? Vec<d>(vec<d>(body.velocity) * time)
                                                     : free_motion<d>(scene, body, hull, time);
  if (!scene.tank) return moved;
  const auto box = extents<d>(hull);
  const auto tank = extents<d>(*scene.tank);
  for (int k = 0; k < d; ++k)
    moved[k] =
        std::clamp(moved[k], std::min(0., tank.min()[k] - box.min()[k]), std::max(0., tank.max()[k] - box.max()[k]));
  return moved;
}

template double wetted_half<2>(const Scene&, const Body&, double);
template double wetted_half<3>(const Scene&, const Body&, double);
template Vec<2> guessed_motion<2>(const Scene&, const Body&, double);
template Vec<3> guessed_motion<3>(const Scene&, const Body&, double);

}  // namespace splashdown::apps
