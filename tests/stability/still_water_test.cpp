// Tanks drawn at random, at rest for 1000 s.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace fs = fluid::scenes;
using coupling::scenes::g;
using fluid::Fluid;

class RandomTank : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomTank, testing::Range(0u, 20u));

TEST_P(RandomTank, stays_still_for_a_thousand_seconds) {
  std::mt19937 random(GetParam());
  auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const double width = between(0.5, 3), depth = between(0.1, 1.5), surface = width / between(5, 25);
  for (double share : {0.5, 1.0}) {  // of sqrt(h / g) as the usual largest step, and of the criterion alone
    auto spec = fs::still_water(width, depth, surface * between(1, 3));
    spec.size = {.surface = surface, .far = spec.size.far, .growth = between(0.1, 0.3)};
    const double none = std::numeric_limits<double>::infinity();
    spec.step = {.cfl = share, .dt_max = share < 1 ? share * std::sqrt(surface / g) : none};
    coupling::scenes::Watched<2> stepper(std::make_unique<Fluid<2>>(spec, fs::gravity({0, -g})));
    double dt = 1e-3;
    while (stepper.time() < 1000) {
      dt = std::min(stepper.stable_dt(), 1.5 * dt);
      ASSERT_TRUE(stepper.attempt(dt).ok());
      stepper.commit();
    }
    double speed = 0;
    for (const auto& v : stepper.fluid().nodes().v) speed = std::max(speed, v.norm());
    EXPECT_LE(speed, 1e-6 * std::sqrt(g * depth)) << "dt = " << dt;
    const auto& ledger = stepper.fluid().ledger();
    EXPECT_NEAR(ledger.volume, ledger.volume_initial, 1e-8 * ledger.volume_initial);
  }
}

}  // namespace
}  // namespace splashdown
