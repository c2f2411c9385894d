#include "apps/check/statics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "apps/statistics/attitude.hpp"

namespace splashdown::apps {
namespace {

/// Where the lever changes its sign from positive [deg], linear between rows; nothing if it does not.
std::optional<double> vanishing(const std::vector<rigid::Heeled>& curve) {
  for (std::size_t i = 2; i < curve.size(); ++i) {
    const double before = curve[i - 1].lever, after = curve[i].lever;
    if (after > 0 || !(before > 0)) continue;
    return (curve[i - 1].heel + before / (before - after) * (curve[i].heel - curve[i - 1].heel)) / radians;
  }
  return {};
}

void add_stability(const Scene&, const Resting<2>& resting, double, AtRest& rest) {
  rest.gm_pitch = resting.floats->metacentric_height;
}

void add_stability(const Scene& scene, const Resting<3>& resting, double level, AtRest& rest) {
  const auto [roll, pitch] = metacentric_heights(resting);
  rest.gm_roll = roll, rest.gm_pitch = pitch;
  const auto righting = righting_of(scene, resting, level);
  if (righting.round) return;
  for (const auto& at : righting.curve) {
    rest.heels.push_back(at.heel / radians);
    rest.levers.push_back(at.lever);
  }
  rest.rights_up_to = righting.rights ? righting.range : 0;
}

void add_attitude(const rigid::Isometry<2>& pose, AtRest& rest) {
  rest.trim = without_roundoff(attitude_deg<2>(pose.linear())[1]);
}
void add_attitude(const rigid::Isometry<3>& pose, AtRest& rest) {
  const auto angles = attitude_deg<3>(pose.linear());
  rest.heel = without_roundoff(angles[0]), rest.trim = without_roundoff(angles[1]);
}

template <int d>
AtRest numbers_of_rest(const Scene& scene, std::size_t number, const Resting<d>& resting, double level) {
  AtRest rest;
  if (resting.held) {
    rest.held = held_text<d>(scene, number, *resting.held);
    rest.sinks = resting.held->sinks;
    rest.draft = resting.held->draft;
    add_attitude(resting.held->pose, rest);
  } else if (resting.floats) {
    rest.draft = resting.floats->draft;
    add_attitude(resting.floats->pose, rest);
    add_stability(scene, resting, level, rest);
  } else {
    rest.sinks = true;
  }
  return rest;
}

}  // namespace

double without_roundoff(double degrees) { return std::abs(degrees) < 1e-6 ? 0 : degrees; }

template <int d>
double diagonal(const rigid::BodySpec<d>& spec) {
  return extents<d>(spec.surface).diagonal().norm();
}

Righting righting_of(const Scene& scene, const Resting<3>& resting, double level) {
  const auto& spec = resting.spec;
  std::vector<double> heels;
  for (int degree = 0; degree <= 180; degree += 15) heels.push_back(degree * radians);
  Righting righting;
  righting.curve = rigid::righting_levers(spec.surface, *resting.floats, spec.mass, scene.fluid->density, level,
                                          rigid::length_axis(*resting.floats), heels);
  const auto& curve = righting.curve;
  const auto most = std::ranges::max_element(curve, {}, &rigid::Heeled::lever);
  const double last = curve.back().heel / radians, size = diagonal<3>(spec), round_off = 1e-9 * size;
  righting.most = most->lever, righting.most_at = most->heel / radians;
  righting.ends = last < 180 - 1e-9;
  righting.round = !righting.ends && most->lever < facets_of_round * size;
  righting.range = vanishing(curve).value_or(last);
  righting.rights = curve.size() < 2 || curve[1].lever > -round_off;
  return righting;
}

std::array<double, 2> metacentric_heights(const Resting<3>& resting) {
  const auto& rest = *resting.floats;
  const rigid::Slope<3> length = rigid::length_axis(rest), across(-length.y(), length.x());
  const auto height = [&](const rigid::Slope<3>& direction) {
    const double gm = rigid::metacentric_height<3>(rest, direction);
    return std::abs(gm) < facets_of_round * diagonal<3>(resting.spec) ? 0 : gm;
  };
  return {height(across), height(length)};
}

template <int d>
std::string held_text(const Scene& scene, std::size_t number, const rigid::BodyAtRest<d>& rest) {
  const Body& body = scene.bodies[number];
  std::vector<std::string> reasons;
  if (body.free.size() < freedom_names(d).size())
    reasons.push_back(fmt::format("free in {} only", fmt::join(body.free, ", ")));
  for (const auto& joint : scene.joints) {
    if (joint.body != number && joint.other != number) continue;
    const auto other = joint.body == number ? joint.other : std::optional(joint.body);
    reasons.push_back(fmt::format("{} to {}", joint.type, other ? scene.bodies[*other].name : "the world"));
  }
  if (rest.touches) reasons.emplace_back("touches what it meets");
  return fmt::format("{}", fmt::join(reasons, "; "));
}

template <int d>
std::vector<std::optional<AtRest>> statics_of(const Scene& scene) {
  std::vector<std::optional<AtRest>> statics(scene.bodies.size());
  const auto level = still_water_level<d>(scene);
  if (!level) return statics;
  const auto resting = at_rest<d>(scene);
  for (std::size_t i = 0; i < resting.size(); ++i)
    if (resting[i]) statics[i] = numbers_of_rest<d>(scene, i, *resting[i], *level);
  return statics;
}

template double diagonal<2>(const rigid::BodySpec<2>&);
template double diagonal<3>(const rigid::BodySpec<3>&);
template std::string held_text<2>(const Scene&, std::size_t, const rigid::BodyAtRest<2>&);
template std::string held_text<3>(const Scene&, std::size_t, const rigid::BodyAtRest<3>&);
template std::vector<std::optional<AtRest>> statics_of<2>(const Scene&);
template std::vector<std::optional<AtRest>> statics_of<3>(const Scene&);

}  // namespace splashdown::apps
