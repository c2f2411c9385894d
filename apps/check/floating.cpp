#include "apps/check/floating.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/check/words.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "apps/statistics/attitude.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::apps {
namespace {

/// Round-off of an angle that is meant to be zero is not shown.
double shown(double degrees) { return std::abs(degrees) < 1e-6 ? 0 : degrees; }

double extent(const rigid::BodySpec<3>& spec) { return extents<3>(spec.surface).diagonal().norm(); }

/// Levers below this share of the extent are those of a round body's facets.
constexpr double facets = 1e-4;

void describe(const Scene&, const rigid::BodySpec<2>&, const rigid::Floating<2>& rest, double level) {
  const auto angles = attitude_deg<2>(rest.pose.linear());
  row("at rest",
      fmt::format("floats with a draft of {:.5g} m, pitch {:.4g} deg, GM {:.4g} m, centre of mass "
                  "{:.4g} m above the water",
                  rest.draft, shown(angles[1]), rest.metacentric_height, rest.pose.translation().y() - level));
}

/// The horizontal direction in which the nose (x axis of the shape) points, that of the world's x if it points up.
rigid::Slope<3> length_axis(const rigid::Floating<3>& rest) {
  const rigid::Slope<3> nose = rest.pose.linear().col(0).head<2>();
  const double upright = 0.1;
  return nose.norm() > upright ? rigid::Slope<3>(nose.normalized()) : rigid::Slope<3>::UnitX();
}

void print_levers(const Scene& scene, const rigid::BodySpec<3>& spec, const rigid::Floating<3>& rest, double level) {
  std::vector<double> heels;
  for (int degree = 0; degree <= 180; degree += 15) heels.push_back(degree * radians);
  const auto curve =
      rigid::righting_levers(spec.surface, rest, spec.mass, scene.fluid->density, level, length_axis(rest), heels);
  const auto most =
      std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.lever < b.lever; });
  if (most->lever < facets * extent(spec))
    return row("righting levers", "none to speak of: a round body keeps any heel");
  // Positive from rest to where the lever changes its sign, linear between the rows.
  double range = 180;
  for (std::size_t i = 2; i < curve.size(); ++i)
    if (curve[i].lever <= 0) {
      const double share = curve[i - 1].lever / (curve[i - 1].lever - curve[i].lever);
      range = (curve[i - 1].heel + share * (curve[i].heel - curve[i - 1].heel)) / radians;
      break;
    }
  row("righting levers",
      fmt::format("heel about its length, to starboard, free to sink and to trim: GZ {:.4g} m at most, near "
                  "{:g} deg; it rights itself up to about {:.0f} deg",
                  most->lever, std::round(most->heel / radians), range));
  row("", "heel [deg]     GZ [m]  draft [m]");
  for (const auto& point : curve) {
    const double lever = std::abs(point.lever) < 1e-9 * extent(spec) ? 0 : point.lever;
    row("", fmt::format("{:10.0f} {:10.4f} {:10.4f}", point.heel / radians, lever, point.floating.draft));
  }
}

void describe(const Scene& scene, const rigid::BodySpec<3>& spec, const rigid::Floating<3>& rest, double level) {
  const auto angles = attitude_deg<3>(rest.pose.linear());
  row("at rest",
      fmt::format("floats with a draft of {:.5g} m, heel (roll) {:.4g} deg, trim (pitch) {:.4g} deg, centre of mass "
                  "{:.4g} m above the water",
                  rest.draft, shown(angles[0]), shown(angles[1]), rest.pose.translation().z() - level));
  const rigid::Slope<3> length = length_axis(rest), across(-length.y(), length.x());
  const auto height = [&](const rigid::Slope<3>& direction) {
    const double gm = rigid::metacentric_height<3>(rest, direction);
    return std::abs(gm) < facets * extent(spec) ? 0 : gm;
  };
  row("metacentric heights", fmt::format("GM {:.4g} m in roll, {:.4g} m in pitch; water plane {:.4g} m^2",
                                         height(across), height(length), rest.submerged.waterline));
  print_levers(scene, spec, rest, level);
}

}  // namespace

template <int d>
void print_floating(const Scene& scene, const rigid::BodySpec<d>& spec) {
  const auto level = still_water_level<d>(scene);
  if (!level || !scene.gravity) return;
  const auto rest = rigid::floating_stable<d>(spec.surface, spec.pose, spec.mass, scene.fluid->density, *level);
  if (!rest) return row("at rest", "sinks: heavier than the water it can displace");
  describe(scene, spec, *rest, *level);
}

template void print_floating<2>(const Scene&, const rigid::BodySpec<2>&);
template void print_floating<3>(const Scene&, const rigid::BodySpec<3>&);

}  // namespace splashdown::apps
