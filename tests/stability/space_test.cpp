// Three dimensions: a light ball that lands on water. Bits, light bodies, rest.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/pfem/parallel.hpp"
#include "tests/unit/coupling/ball_in_tank.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using scenes::g;
using scenes::saved;

constexpr double radius = scenes::BallInTank::radius;

std::unique_ptr<coupling::scenes::Watched<3>> ball(double density_ratio, double height, double speed, double h) {
  const auto scene = scenes::ball_in_tank(density_ratio, height, speed, h, 4 * h, 32);
  return std::make_unique<coupling::scenes::Watched<3>>(scenes::water_of(scene), scenes::bodies_of(scene));
}

TEST(BallInSpace, lands_with_the_same_bits_on_any_number_of_threads) {
  std::string first;
  for (int threads : {1, 2, 8}) {
    fluid::use_threads(threads);
    const auto stepper = ball(1.0 / 3, radius, 3, 0.12);
    EXPECT_EQ(scenes::run(*stepper, 12, 2e-3), 1);
    EXPECT_GT(stepper->fluid().result().loads[0].wetted, 0);
    if (first.empty()) first = saved(*stepper);
    EXPECT_TRUE(saved(*stepper) == first) << threads;
  }
  fluid::use_threads(0);
}

TEST(BallInSpace, resumed_while_it_lands_goes_on_bit_for_bit) {
  const auto whole = ball(1.0 / 3, radius, 3, 0.12), resumed = ball(1.0 / 3, radius, 3, 0.12);
  ASSERT_EQ(scenes::run(*whole, 8, 2e-3), 1);
  EXPECT_TRUE(scenes::go_on_alike(*whole, *resumed, 4, 1e-3));
}

TEST(BallInSpace, of_any_density_lands_in_one_pass_and_settles_its_momentum) {
  // Lighter than the added mass by far: 1e-3 of water at 3 m/s must be stopped, not thrown.
  for (double ratio : {1.0 / 3, 0.01, 1e-3}) {
    const auto stepper = ball(ratio, radius, 3, 0.12);
    double dt = 2e-3;
    for (int i = 0; i < 25; ++i) {
      dt = std::min(stepper->stable_dt(), 1.5 * dt);
      const auto report = scenes::attempt_halving(*stepper, dt, 9);
      ASSERT_TRUE(report.ok()) << ratio << " at " << stepper->time() << ": " << report.cause;
      EXPECT_EQ(report.passes, 1);
      stepper->commit();
      // Nothing gives it more energy than it brought and gains by falling; drops may carry some of it upwards.
      EXPECT_LE(stepper->bodies().state(0).velocity.norm(), 3 * 1.05 + g * stepper->time()) << ratio;
    }
    const auto& ledger = stepper->fluid().ledger();
    EXPECT_LE(std::abs(ledger.volume + ledger.spray - ledger.volume_initial), 0.005 * ledger.volume_initial) << ratio;
  }
}

}  // namespace
}  // namespace splashdown
