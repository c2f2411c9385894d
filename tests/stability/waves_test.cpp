// A minute afloat in waves.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using coupling::scenes::Vec;

// A standing wave, a box of half of water's density on it, walls all round.
TEST(Box, afloat_in_waves_for_a_minute_keeps_the_volume_and_gains_no_speed) {
  const double amplitude = 0.02, half = 1, depth = 0.6, wavenumber = std::numbers::pi / half;
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(2 * half, depth, 0.06);
  s.fluid.size = {.surface = 0.03, .far = 0.06, .growth = 0.2};
  std::vector<Vec> outline{{-half, -depth}, {half, -depth}};
  for (double x = half; x > -half - 1e-9; x -= 0.05) outline.push_back({x, amplitude * std::cos(wavenumber * x)});
  s.fluid.liquids[0].boundary = fluid::scenes::outline(outline);
  const auto box = rigid::box(0.3, 0.2);
  s.add_body(box, 0.5 * scenes::water * box.at_unit_density.mass, {0, 0}, 0.03);
  const auto stepper = scenes::coupled(s);
  // The box starts a trough's depth off its rest at most and is lifted by the wave: their speeds together, the one of
  // free heave, sqrt(g / draft), above that of the wave, sqrt(g k).
  const double fastest = 2 * amplitude * std::sqrt(scenes::g / 0.1);
  double dt = 1e-3;
  while (stepper->time() < 60) {
    dt = std::min({stepper->stable_dt(), 1.5 * dt, 0.02});
    while (!stepper->attempt(dt).ok()) {
      dt *= 0.5;
      ASSERT_GT(dt, 1e-6) << stepper->time();
    }
    stepper->commit();
    const auto& l = stepper->fluid().ledger();
    ASSERT_LE(std::abs(l.volume + l.spray - l.volume_initial), 1e-3 * l.volume_initial) << stepper->time();
    ASSERT_LE(std::abs(stepper->bodies().state(0).velocity[1]), fastest) << stepper->time();
  }
}

}  // namespace
}  // namespace splashdown
