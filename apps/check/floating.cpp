#include "apps/check/floating.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/check/statics.hpp"
#include "apps/check/words.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "apps/statistics/attitude.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::apps {
namespace {

std::string attitude_text(const rigid::Isometry<2>& pose) {
  return fmt::format("pitch {:.4g} deg", without_roundoff(attitude_deg<2>(pose.linear())[1]));
}
std::string attitude_text(const rigid::Isometry<3>& pose) {
  const auto angles = attitude_deg<3>(pose.linear());
  return fmt::format("heel (roll) {:.4g} deg, trim (pitch) {:.4g} deg", without_roundoff(angles[0]),
                     without_roundoff(angles[1]));
}

std::string height_text(double height) { return fmt::format("{:.4g} m above the water", height); }

/// What is taken for granted about water in hollows.
template <int d>
void print_hollow(const Resting<d>& resting, double freeboard, rigid::Hollow then) {
  if (resting.filled)
    return row("hollow",
               "a region reaches into it: taken as flooded, with the level of the water outside; end the "
               "region at the hull if it is to be dry");
  if (then == rigid::Hollow::flooded)
    return row("hollow", "water is over its rim at t = 0, or comes over it on the way to rest: taken as flooded");
  if (std::isfinite(freeboard))
    row("hollow", fmt::format("dry until water comes over its rim, {:.4g} m above the water at rest", freeboard));
}

void describe(const Scene&, const Resting<2>& resting, double level) {
  const auto& rest = *resting.floats;
  row("at rest",
      fmt::format("floats with a draft of {:.5g} m, {}, GM {:.4g} m, centre of mass {}", rest.draft,
                  attitude_text(rest.pose), rest.metacentric_height, height_text(rest.pose.translation().y() - level)));
}

/// Where a value that rows of a curve have changes its sign from positive [deg], linear between them; nothing if it does not.
template <class Value>
std::optional<double> zero_of(const std::vector<rigid::Heeled>& curve, std::size_t from, const Value& value) {
  for (std::size_t i = from; i < curve.size(); ++i) {
    const double before = value(curve[i - 1]);
    if (value(curve[i]) > 0 || !(before > 0)) continue;
    const double share = before / (before - value(curve[i]));
    return (curve[i - 1].heel + share * (curve[i].heel - curve[i - 1].heel)) / radians;
  }
  return {};
}

/// Where the curve is not that of a body that is left alone.
void print_trim(const std::vector<rigid::Heeled>& curve, double round_off) {
  const auto unstable =
      zero_of(curve, 1, [&](const rigid::Heeled& at) { return at.jumped ? 1 : at.trim_height + round_off; });
  if (unstable)
    row("", fmt::format("beyond {:.0f} deg its trim is balanced, but not stable: left alone it leaves this curve",
                        *unstable));
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (curve[i].jumped)
      row("",
          fmt::format("between {:.0f} and {:.0f} deg it loses its stability in trim: it goes from {:.3g} to {:.3g} deg",
                      curve[i - 1].heel / radians, curve[i].heel / radians,
                      without_roundoff(curve[i - 1].trim / radians), without_roundoff(curve[i].trim / radians)));
}

void print_levers(const Scene& scene, const Resting<3>& resting, double level) {
  const auto righting = righting_of(scene, resting, level);
  const auto& curve = righting.curve;
  if (righting.round) return row("righting levers", "none to speak of: a round body keeps any heel");
  row("righting levers",
      fmt::format("heel about its length, to starboard, free to sink and to trim: GZ {:.4g} m at most, near "
                  "{:g} deg; it {}",
                  righting.most, std::round(righting.most_at),
                  righting.rights ? fmt::format("rights itself up to about {:.0f} deg", righting.range)
                                  : "does not right itself"));
  const double size = diagonal<3>(resting.spec), round_off = 1e-9 * size;
  print_trim(curve, facets_of_round * size);
  if (righting.ends)
    row("", fmt::format("at {:.1f} deg {}", curve.back().heel / radians,
                        std::isfinite(curve.back().floating.freeboard) ? "water comes over the rim of its hollow"
                                                                       : "it trims until it stands on end"));
  row("", "heel [deg]     GZ [m]  draft [m]");
  for (const auto& point : curve) {
    const double lever = std::abs(point.lever) < round_off ? 0 : point.lever;
    row("", fmt::format("{:10.0f} {:10.4f} {:10.4f}", point.heel / radians, lever, point.floating.draft));
  }
}

void describe(const Scene& scene, const Resting<3>& resting, double level) {
  const auto& rest = *resting.floats;
  row("at rest", fmt::format("floats with a draft of {:.5g} m, {}, centre of mass {}", rest.draft,
                             attitude_text(rest.pose), height_text(rest.pose.translation().z() - level)));
  const auto [roll, pitch] = metacentric_heights(resting);
  row("metacentric heights", fmt::format("GM {:.4g} m in roll, {:.4g} m in pitch; water plane {:.4g} m^2", roll, pitch,
                                         rest.submerged.waterline));
  print_levers(scene, resting, level);
}

template <int d>
void describe_held(const Scene& scene, std::size_t number, const Resting<d>& resting, double level) {
  const auto& rest = *resting.held;
  const auto held = held_text<d>(scene, number, rest);
  const bool heavy =
      resting.spec.mass >= scene.fluid->density * shape_of<d>(scene.bodies[number].shape).at_unit_density.mass;
  if (rest.sinks)
    return row(
        "at rest",
        fmt::format("sinks: {} ({})",
                    heavy ? "heavier than the water it can displace" : "drawn down by what it is tied to", held));
  const auto turned = (rest.pose.linear() * resting.spec.surface.vertices).row(d - 1);
  const double height = turned.maxCoeff() - turned.minCoeff();
  const auto where = rest.draft <= 0 ? fmt::format("hangs {:.5g} m above the water", -rest.draft)
                     : rest.draft >= height
                         ? fmt::format("stays under water, its lowest point {:.5g} m deep", rest.draft)
                         : fmt::format("floats with a draft of {:.5g} m", rest.draft);
  row("at rest", fmt::format("{}, {}, centre of mass {} ({})", where, attitude_text(rest.pose),
                             height_text(rest.pose.translation()(d - 1) - level), held));
  print_hollow<d>(resting, rest.freeboard, rest.hollow);
}

}  // namespace

template <int d>
void print_floating(const Scene& scene, std::size_t body, const Resting<d>& resting) {
  const double level = *still_water_level<d>(scene);
  if (resting.held) return describe_held<d>(scene, body, resting, level);
  if (!resting.floats) {
    const bool had_hollow =
        !resting.filled && !rigid::hollow_bottoms<d>(resting.spec.surface, resting.spec.pose).empty();
    row("at rest", had_hollow ? "sinks: heavier than the water it can displace, or its hollow is flooded first"
                              : "sinks: heavier than the water it can displace");
    return print_hollow<d>(resting, std::numeric_limits<double>::infinity(), rigid::Hollow::dry);
  }
  describe(scene, resting, level);
  print_hollow<d>(resting, resting.floats->freeboard, resting.floats->hollow);
}

template void print_floating<2>(const Scene&, std::size_t, const Resting<2>&);
template void print_floating<3>(const Scene&, std::size_t, const Resting<3>&);

}  // namespace splashdown::apps
