#include "apps/scene/outlook/motion_guess.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

template <int d>
double mass_guess(const Body& body) {
  return body.mass || body.density ? mass_properties<d>(body).mass : 0;
}

/// By how much the water line is higher than that of still water where it decides the added mass (outlook.hpp).
template <int d>
constexpr double raised_depth = d == 2 ? 1.25 : 1;

/// Heights over that of the arrival, at equal intervals.
template <int d>
void sink(GuessedFall<d>& fall, const GuessedBody<d>& body, double density, double depth, double until) {
  constexpr int intervals = 1000;
  fall.interval = std::max(0., until - fall.arrival) / intervals;
  const double g = -fall.gravity[d - 1];
  double up = fall.velocity[d - 1] - g * fall.arrival, height = 0, moving = body.mass;
  for (int i = 0; i <= intervals; ++i) {
    fall.sunk.push_back(height);
    const auto wet = body.immersion.at(depth - height);
    const double plan = body.immersion.at(raised_depth<d> * (depth - height)).plan;
    const double inertia = body.mass + plate_mass<d>(density, plan);
    if (inertia > moving) up *= moving / inertia;  // what it takes with it; what it leaves behind keeps its speed
    moving = inertia;
    if (moving > 0) up += fall.interval * g * (density * wet.volume - body.mass) / moving;
    height += fall.interval * up;
  }
}

/// Of a body that is free from `begins` on, `raised` over where it is at t = 0.
template <int d>
GuessedFall<d> fall_from(const Scene& scene, const GuessedBody<d>& body, double begins, const Vec<d>& velocity,
                         double raised) {
  GuessedFall<d> fall;
  fall.begins = begins;
  fall.velocity = velocity;
  if (scene.gravity) fall.gravity = vec<d>(scene.gravity->acceleration);
  for (int k = 0; k < d; ++k)
    if (!moves_along(*body.body, k)) fall.velocity[k] = fall.gravity[k] = 0;
  fall.arrival = std::numeric_limits<double>::infinity();
  const auto level = still_water_level<d>(scene);
  if (!level) return fall;
  const double over = extents<d>(body.hull).min()[d - 1] + raised - *level;
  const double way = std::max(0., over), g = std::max(0., -fall.gravity[d - 1]), down = -fall.velocity[d - 1];
  const double until = scene.time.end - begins, reach = std::sqrt(std::max(0., down * down + 2 * g * way));
  fall.arrival = way == 0 ? 0 : g > 0 ? (reach - down) / g : down > 0 ? way / down : until;
  if (fall.arrival >= until) return fall;
  const double density = scene.fluid ? scene.fluid->density : 0, depth = std::max(0., -over);
  const double added = plate_mass<d>(density, body.immersion.at(depth).plan);
  if (added > 0) fall.share = body.mass / (body.mass + added);
  if (moves_along(*body.body, d - 1)) sink<d>(fall, body, density, depth, until);
  return fall;
}

template <int d>
double immersed_depth(const Scene& scene, const GuessedBody<d>& body, const Vec<d>& moved) {
  const auto level = still_water_level<d>(scene);
  return level ? *level - extents<d>(body.hull).min()[d - 1] - moved[d - 1] : 0;
}

/// What will be under water at a time, with the water that rises beside a wedge.
template <int d>
Immersion<d> wetted_part(const Scene& scene, const GuessedBody<d>& body, const Vec<d>& moved, double time) {
  const double depth = immersed_depth<d>(scene, body, moved);
  return body.immersion.at(time > 0 ? pi / 2 * depth : depth);
}

}  // namespace

template <int d>
Vec<d> GuessedFall<d>::moved(double time) const {
  const double in_air = std::min(time, arrival), in_water = std::max(0., time - arrival);
  Vec<d> way = velocity * in_air + 0.5 * in_air * in_air * gravity + share * in_water * (velocity + gravity * in_air);
  if (in_water == 0) return way;
  way[d - 1] = velocity[d - 1] * in_air + 0.5 * in_air * in_air * gravity[d - 1];
  if (sunk.empty()) return way;
  const double place = interval > 0 ? in_water / interval : 0;
  const auto from = std::min(static_cast<std::size_t>(place), sunk.size() - 1),
             to = std::min(from + 1, sunk.size() - 1);
  way[d - 1] += sunk[from] + (place - static_cast<double>(from)) * (sunk[to] - sunk[from]);
  return way;
}

template <int d>
GuessedBody<d> guessed_body(const Scene& scene, const Body& body) {
  auto hull = outline<d>(body);
  ImmersionTable<d> immersion(hull);
  GuessedBody<d> guessed{&body, std::move(hull), mass_guess<d>(body), 0, std::move(immersion), {}};
  guessed.impact_mass = scene.fluid ? impact_mass(scene.fluid->density, guessed.hull) : 0;
  if (body.release && body.release->time) {
    const double carried = *body.release->time, instant = 1e-6 * carried;
    const Vec<d> moved = vec<d>(body.path.empty() ? Point(body.velocity * carried) : along_path(body, carried));
    Vec<d> velocity = vec<d>(body.velocity);
    if (!body.path.empty() && instant > 0) velocity = (moved - vec<d>(along_path(body, carried - instant))) / instant;
    guessed.fall = fall_from<d>(scene, guessed, carried, velocity, moved[d - 1]);
  } else if (body.motion == Motion::free) {
    guessed.fall = fall_from<d>(scene, guessed, 0, vec<d>(body.velocity), 0);
  }
  return guessed;
}

template <int d>
double wetted_half(const Scene& scene, const Body& of, double time) {
  const auto level = still_water_level<d>(scene);
  if (!level) return 0;
  const auto body = guessed_body<d>(scene, of);
  auto hull = body.hull;
  hull.vertices.colwise() += guessed_motion<d>(scene, body, time);
  const double depth = std::max(0., *level - extents<d>(hull).min()[d - 1]);
  const auto wet =
      Immersion<d>::of(hull, *level + (time > 0 ? (pi / 2 - 1) * depth : 0));  // exact: sizes are chosen by it
  return wet.dry() ? 0 : (wet.high - wet.low).template head<d - 1>().maxCoeff() / 2;
}

template <int d>
double wetted_length(const Scene& scene, const GuessedBody<d>& body, double time) {
  return std::pow(wetted_part<d>(scene, body, guessed_motion<d>(scene, body, time), time).wetted, 1. / (d - 1)) / 2;
}

template <int d>
std::optional<WettedEnds<d>> wetted_ends(const Scene& scene, const GuessedBody<d>& body, double time) {
  const auto wet = wetted_part<d>(scene, body, guessed_motion<d>(scene, body, time), time);
  if (wet.dry()) return {};
  WettedEnds<d> ends;
  ends << wet.low.template head<d - 1>(), wet.high.template head<d - 1>();
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

template <>
double plate_mass<2>(double density, double plan) {
  return density * pi / 8 * plan * plan;
}
template <>
double plate_mass<3>(double density, double plan) {
  return density * 4. / 3 * std::pow(plan / pi, 1.5);
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
Vec<d> carried_and_let_go(const GuessedBody<d>& guessed, double time) {
  const Body& body = *guessed.body;
  const double carried = guessed.fall.begins;
  const Point moved = body.path.empty() ? Point(body.velocity * carried) : along_path(body, carried);
  return vec<d>(moved) + guessed.fall.moved(time - carried);
}

template <int d>
Vec<d> guessed_motion(const Scene& scene, const GuessedBody<d>& guessed, double time) {
  const Body& body = *guessed.body;
  if (body.motion == Motion::fixed || time == 0) return Vec<d>::Zero();
  const auto box = extents<d>(guessed.hull);
  Vec<d> moved = is_let_go(body, time)               ? carried_and_let_go<d>(guessed, time)
                 : !body.path.empty()                ? vec<d>(along_path(body, time))
                 : body.motion == Motion::prescribed ? Vec<d>(vec<d>(body.velocity) * time)
                                                     : guessed.fall.moved(time);
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
template double wetted_length<2>(const Scene&, const GuessedBody<2>&, double);
template double wetted_length<3>(const Scene&, const GuessedBody<3>&, double);
template struct GuessedFall<2>;
template struct GuessedFall<3>;
template double wetted_half<2>(const Scene&, const Body&, double);
template double wetted_half<3>(const Scene&, const Body&, double);
template std::optional<WettedEnds<2>> wetted_ends<2>(const Scene&, const GuessedBody<2>&, double);
template std::optional<WettedEnds<3>> wetted_ends<3>(const Scene&, const GuessedBody<3>&, double);
template Vec<2> guessed_motion<2>(const Scene&, const Body&, double);
template Vec<3> guessed_motion<3>(const Scene&, const Body&, double);

}  // namespace splashdown::apps
