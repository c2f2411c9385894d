// What is around hull and water: the sea, the air, the hull's own softness.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/effects/theory/theory.hpp"
#include "apps/effects/waves/table.hpp"
#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

/// Under less air is trapped (Chuang 1967); well above it is not.
constexpr double trapping = 3 * radians, free_of_air = 5 * radians;

}  // namespace

/// The sea of the scene meets the body with its orbital velocity pi H/T, and moves all that does not move by itself.
Advice advise_given_waves(const Outlook& look, const Waves& sea) {
  const double height = sea.height > 0               ? sea.height
                        : sea.significant_height > 0 ? sea.significant_height
                                                     : 2 * sea.crest;
  const double length = sea.length.value_or(0), period = sea.period ? *sea.period
                                                         : sea.length && look.pull > 0
                                                             ? std::sqrt(2 * pi * length / look.pull)
                                                             : sea.peak_period;
  Advice advice;
  advice.source = "orbital velocity pi H/T of deep water (Airy 1845); the load goes with the square of the speed";
  if (period > 0 && height > 0) {
    const double orbital = pi * height / period;
    advice.numbers.push_back({"pi H/T", orbital, "m/s"});
    if (look.has_load()) advice.change.peak = 2 * orbital / look.entry->speed;
  }
  const bool alone = !look.mover || !look.mover->moves || (!look.entry && look.starts_at_rest());
  advice.advised = alone ? Advised::on : std::max(Advised::doubtful, judged(advice.change));
  advice.reason =
      alone ? "the sea is what moves the water" : "the sea changes the speed of the impact and what comes after";
  return advice;
}

/// A wave five hulls long meets the body with its orbital velocity pi H/T and its slope.
Advice advise_waves(const Outlook& look) {
  if (const auto* sea = look.scene.effects.find<Waves>()) return advise_given_waves(look, *sea);
  Advice advice;
  advice.source = "orbital velocity pi H/T of deep water (Airy 1845); the load goes with the square of the speed";
  const bool lands = look.has_load() && look.mover && look.mover->moves;
  if (look.pull <= 0 || !look.mover || !look.mover->moves) {
    advice.reason = look.pull <= 0 ? "without gravity there are none" : "no body moves in the water";
    return advice;
  }
  const double length = 5 * look.mover->length, period = std::sqrt(2 * pi * length / look.pull);
  const double steep = 0.05;  // of a sea in which something lands
  advice.numbers.push_back({"wave steepness H/lambda assumed", steep});
  advice.numbers.push_back({"H/L of the body", steep * length / look.mover->length});
  if (lands) {
    const double orbital = pi * steep * length / period;
    advice.change.peak = 2 * orbital / look.entry->speed;
    advice.numbers.push_back({"H that changes the peak by 10 %", 0.1 / *advice.change.peak * steep * length, "m"});
  }
  advice.advised = Advised::doubtful;
  advice.reason =
      "the scene says nothing of the sea: still water is right for a tank, and on the sea a matter of its height";
  return advice;
}

/// Drag in the fall, and lift of what flies.
Advice advise_wind(const Outlook& look) {
  const double drag = 1;
  Advice advice;
  advice.source = "drag of a blunt body, 1 (Hoerner 1965); Tachikawa 1983";
  if (!look.mover || look.mover->mass == 0 || !std::isfinite(look.mover->mass) || look.pull <= 0) {
    advice.reason = "no body flies freely";
    return advice;
  }
  const auto& mover = *look.mover;
  const double speed = std::max(look.scales.speed, mover.forward);
  const double tachikawa = dynamic_pressure(air_density, speed) * mover.plan / (mover.mass * look.pull);
  advice.numbers.push_back({"Tachikawa number rho_air U^2 A/2 m g", tachikawa});
  // Over the fall the speed's square falls short by rho_air C_D A h / m.
  if (look.entry) advice.change.peak = drag * air_density * mover.plan * look.entry->height / mover.mass;
  if (mover.forward > 0) advice.change.motion = std::min(1., tachikawa);  // lift over weight, of order 1
  advice.advised = judged(advice.change);
  advice.reason = advice.advised == Advised::off ? "the air takes next to nothing of its speed"
                  : mover.forward > 0            ? "lift carries a part of its weight, and drag slows it"
                                                 : "drag slows its fall";
  return advice;
}

Advice advise_trapped_air(const Outlook& look) {
  Advice advice;
  advice.source = "air is trapped below 3 degrees of deadrise (Chuang 1967); the layer, Verhagen 1967";
  if (!look.entry) {
    advice.reason = "nothing comes down on the water";
    return advice;
  }
  const auto& entry = *look.entry;
  advice.numbers.push_back({"trapped-air number V/2c_air", entry.speed / (2 * air_sound_speed)});
  if (!entry.deadrise) {
    advice.change.peak = 0;
    advice.reason = "air escapes beside a round bottom";
    return advice;
  }
  advice.numbers.push_back({"deadrise over 3 deg", *entry.deadrise / trapping});
  advice.advised = *entry.deadrise < trapping      ? Advised::on
                   : *entry.deadrise < free_of_air ? Advised::doubtful
                                                   : Advised::off;
  if (advice.advised == Advised::off) advice.change.peak = 0;
  advice.reason = advice.advised == Advised::off
                      ? "air escapes beside the bottom"
                      : "a cushion of air takes the peak of the pressure off, to about a tenth of "
                        "rho c V in Chuang's tests, and spreads the impulse over milliseconds";
  return advice;
}

/// No scene says how stiff its hull is: what is told is the frequency above which a panel is as good as rigid.
Advice advise_elasticity(const Outlook& look) {
  const double aluminium = 70e9, flat = 15 * radians;  // [Pa]; Faltinsen 2000
  Advice advice;
  advice.source =
      "twice the period of the lowest wet mode (Bereznitski 2001); small deadrise and high speed, Faltinsen 2000";
  advice.numbers.push_back(
      {"Cauchy rho U^2/E of aluminium", 2 * dynamic_pressure(look.scales.density, look.scales.speed) / aluminium});
  if (!look.entry) {
    advice.reason = "nothing strikes the water";
    return advice;
  }
  const auto& entry = *look.entry;
  if (!entry.flat()) advice.numbers.push_back({"lowest frequency of a rigid panel", 2 / entry.peak_time(), "Hz"});
  const bool gentle = !entry.deadrise || *entry.deadrise >= flat;
  advice.advised = gentle ? Advised::off : Advised::doubtful;
  if (gentle) advice.change.peak = 0;
  advice.reason =
      gentle ? "stiff panels follow such a load without swinging"
             : "so flat a bottom is struck faster than a plate swings: its stresses are not those of a rigid hull";
  return advice;
}

}  // namespace splashdown::apps
