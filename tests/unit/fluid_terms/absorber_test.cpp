#include "fluid/effects/absorber/absorber.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "basin.hpp"
#include "block_of_fluid.hpp"

namespace splashdown::fluid::absorber_test {
namespace {

using testing::Basin;
using testing::Block;

TEST(Absorber, damps_exactly_within_its_zones_and_nothing_outside) {
  Block<2> fluid({20, 4}, 0.1, 0.15);
  fluid.set_velocity([](const Vec<2>& x) { return Vec<2>(1 + x.y(), 2 - x.x()); });
  fluid.kick = 0.05;
  Absorber<2> beach({.from = 0, .to = 2, .width = 0.5, .rate = 8});
  const auto v = fluid.predict(beach);
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double from_end = std::min(fluid.nodes.x[i].x(), 2 - fluid.nodes.x[i].x());
    if (from_end >= 0.5) {
      EXPECT_EQ(v[i], fluid.nodes.v[i]);
      continue;
    }
    const double rate = 8 * std::pow(1 - from_end / 0.5, 2);
    EXPECT_NEAR((v[i] - std::exp(-rate * 0.05) * fluid.nodes.v[i]).norm(), 0, 1e-14);
  }
  EXPECT_NEAR(beach.diagnostics(fluid.nodes, {}).at(0).second * fluid.kick,
              fluid.kinetic_energy(v) - fluid.kinetic_energy(fluid.nodes.v), 1e-10 * fluid.kinetic_energy(v));
}

TEST(Absorber, still_water_stays_still) {
  auto stepper = testing::water(Basin{.length = 2, .size = 0.1}, testing::gravity(),
                                std::make_unique<Absorber<2>>(AbsorberSpec{0, 2, 0.5, 10}));
  double fastest = 0;
  ASSERT_TRUE(testing::run(stepper, 0.5,
                           [&](const auto& fluid, double) { fastest = std::max(fastest, testing::max_speed(fluid)); }));
  EXPECT_LT(fastest, 1e-10);  // sqrt(g h) times roundoff of some fifty direct solves
}

double energy_left(double rate) {
  const Basin basin{.length = 2, .depth = 0.5, .size = 0.08, .amplitude = 0.01};
  const double omega = std::sqrt(9.81 * std::numbers::pi * std::tanh(std::numbers::pi * 0.5));
  const double period = 2 * std::numbers::pi / omega;
  auto stepper =
      rate > 0 ? testing::water(basin, testing::gravity(), std::make_unique<Absorber<2>>(AbsorberSpec{0, 2, 1.0, rate}))
               : testing::water(basin, testing::gravity());
  double last_half_period = 0, at = 0;
  testing::run(stepper, 2.25 * period, [&](const auto& fluid, double) {
    at = fluid.time() / period;
    if (at > 1.75) last_half_period = std::max(last_half_period, testing::kinetic_energy(fluid));
  });
  return last_half_period;
}

// Weak damping of a standing wave, by its energy: dE/dt = -2 int r rho v^2 / 2, and a mean of r over the zone,
// which is the whole basin here, of rate / 3, so E ~ exp(-rate t / 3) if v^2 were uniform and always there.
TEST(Absorber, waves_die_out) {
  const double undamped = energy_left(0), weak = energy_left(0.5), strong = energy_left(5);
  EXPECT_LT(weak, 0.95 * undamped);
  EXPECT_GT(weak, 0.4 * undamped);
  EXPECT_LT(strong, 0.1 * undamped);
}

}  // namespace
}  // namespace splashdown::fluid::absorber_test
