#include "fluid/effects/waves/waves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/fluid_terms/block_of_fluid.hpp"
#include "wave_tank.hpp"

namespace splashdown::fluid::waves_test {
namespace {

using testing::Block;

// A sea that moves everywhere with the same speed.
class Stream final : public WaveField<2> {
 public:
  double elevation(const Vec<2>&, double) const override { return 0; }
  Vec<2> velocity(const Vec<2>& x, double t) const override { return {1 + t, x.y()}; }
  double length() const override { return 1; }
  double period() const override { return 1; }
  double shortest() const override { return 1; }
  double highest() const override { return 0; }
  double lowest() const override { return 0; }
  double phase(const Vec<2>&, double) const override { return 0; }
};

TEST(Waves, pull_exactly_within_their_zones_and_nowhere_else) {
  Block<2> fluid({20, 4}, 0.1, 0.15);
  fluid.set_velocity([](const Vec<2>& x) { return Vec<2>(1 + x.y(), 2 - x.x()); });
  fluid.kick = 0.05;
  Waves<2> waves(std::make_unique<Stream>(), {.min = {0, 0}, .max = {2, 1}, .width = {0.5, 0}, .rate = 8});
  const auto v = fluid.predict(waves);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec<2>& x = fluid.nodes.x[i];
    const double from_end = std::min(x.x(), 2 - x.x());
    if (from_end >= 0.5) {
      EXPECT_EQ(v[i], fluid.nodes.v[i]);
      continue;
    }
    const double kept = std::exp(-8 * std::pow(1 - from_end / 0.5, 2) * 0.05);
    EXPECT_NEAR((v[i] - kept * fluid.nodes.v[i] - (1 - kept) * Vec<2>(1, x.y())).norm(), 0, 1e-13);
  }
}

TEST(Waves, grow_smoothly_from_still_water) {
  const WaveZones<2> zones{.ramp = 2};
  EXPECT_EQ(zones.share_at(0), 0);
  EXPECT_EQ(zones.share_at(1), 0.5);
  EXPECT_EQ(zones.share_at(2), 1);
  EXPECT_EQ(WaveZones<2>{}.share_at(0), 1);
}

// Six periods of a wave in a closed tank of five lengths. Elements of 1/40 of its length: heights within 1.5 %, wave number within
// 0.3 % (docs/waves.md); the work of the zones is booked, so that no energy appears.
TEST(Waves, keep_their_height_and_speed_in_a_closed_tank) {
  testing::WaveTank tank{.wave = {.height = 0.06, .period = 1.2, .depth = 0.4}, .lengths = 5};
  const auto wave = tank.solved();
  auto stepper = tank.stepper();
  const double end = 6 * wave.period(), room = wave.length();
  testing::WaveFit fit(wave, -room, room);
  double next = 4 * wave.period(), first = 0, highest = 0, kinetic = 0;
  const double volume = stepper.fluid().ledger().volume;
  for (int step = 0; stepper.fluid().time() < end; ++step) {
    ASSERT_EQ(stepper.attempt(std::min(stepper.stable_dt(), end - stepper.fluid().time())).cause, "");
    const auto& ledger = stepper.fluid().ledger();
    const double energy = ledger.kinetic_energy + ledger.potential_energy - ledger.work_of_effects;
    if (step == 0) first = energy;
    highest = std::max(highest, energy - first), kinetic = std::max(kinetic, ledger.kinetic_energy);
    if (stepper.fluid().time() >= next) {
      next += wave.period() / 20;
      fit.sample(stepper.fluid().time(), [&](double x) { return testing::elevation_at(stepper.fluid(), x); });
    }
    stepper.commit();
  }
  const auto found = fit.found();
  EXPECT_NEAR(found.amplitude, 1, 0.015);
  EXPECT_LT(found.reflection, 0.02);
  EXPECT_NEAR(found.wave_number, 1, 0.003);
  EXPECT_NEAR(found.level, 0, 0.005 * 0.06);
  EXPECT_LT(highest, 0.01 * kinetic);
  EXPECT_NEAR(stepper.fluid().ledger().volume, volume, 1e-8 * volume);
}

}  // namespace
}  // namespace splashdown::fluid::waves_test
