// Still water stays still: what roundoff, or a ripple, moves does not grow.
#include <gtest/gtest.h>

#include "fluid/pfem/water/wave_bound.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::still_water_test {
namespace {

namespace fs = fluid::scenes;
using coupling::scenes::g;
using fluid::Fluid;
using fluid::Vec;

struct Tank {
  double width, depth, surface, far, growth;
};

fluid::FluidSpec<2> water_in(const Tank& t, double ripple = 0) {
  auto spec = fs::still_water(t.width, t.depth, t.far);
  spec.size = {.surface = t.surface, .far = t.far, .growth = t.growth};
  spec.step = {.cfl = 1, .dt_max = std::numeric_limits<double>::infinity()};
  if (ripple == 0) return spec;
  // Crests and troughs as short as the elements, all along the surface.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-ripple, ripple);
  std::vector<Vec<2>> outline{{-t.width / 2, -t.depth}, {t.width / 2, -t.depth}};
  const int pieces = static_cast<int>(std::lround(t.width / t.surface));
  for (int i = 0; i <= pieces; ++i) outline.push_back({t.width * (0.5 - static_cast<double>(i) / pieces), any(random)});
  spec.liquids[0].boundary = fs::outline(outline);
  return spec;
}

double fastest(const Fluid<2>& f) {
  double v = 0;
  for (const auto& u : f.nodes().v) v = std::max(v, u.norm());
  return v;
}

const Tank tanks[] = {
    {1, 0.3, 0.05, 0.1, 0.2}, {0.7, 0.5, 0.08, 0.08, 0.2}, {1.3, 0.1, 0.06, 0.1, 0.1}, {1, 1, 0.1, 0.3, 0.3}};

class StillWater : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(ShareOfTheBound, StillWater, testing::Values(0.25, 0.5, 1.0));

// A ripple of height a moves at a omega, omega below the bound of the criterion; waves that meet may add up where they do.
// Modes that grow, by a third of a second's e-folding or ten, would be far above after forty seconds.
TEST_P(StillWater, lets_no_ripple_grow) {
  for (const Tank& t : tanks) {
    const double ripple = 1e-6 * t.surface;
    coupling::scenes::Watched<2> stepper(std::make_unique<Fluid<2>>(water_in(t, ripple), fs::gravity({0, -g})));
    double dt = 1e-3, early = 0, late = 0;
    while (stepper.time() < 40) {
      dt = std::min(GetParam() * stepper.stable_dt(), 1.5 * dt);
      ASSERT_TRUE(stepper.attempt(dt).ok());
      stepper.commit();
      double& most = stepper.time() < 4 ? early : late;
      most = std::max(most, fastest(stepper.fluid()));
    }
    EXPECT_LE(late, 2 * early) << t.width << " m, " << t.depth << " m deep";
    const auto& ledger = stepper.fluid().ledger();
    EXPECT_NEAR(ledger.volume, ledger.volume_initial, 1e-8 * ledger.volume_initial);
  }
}

TEST(WaveBound, leaves_the_usual_step_alone) {
  for (const Tank& t : tanks) {
    const Fluid<2> f(water_in(t), fs::gravity({0, -g}));
    const double dt = fluid::wave_dt<2>(f.nodes(), f.mesh(), Vec<2>(0, -g));
    EXPECT_GE(dt, 0.5 * std::sqrt(t.surface / g));
    EXPECT_LE(f.stable_dt(), dt);
    EXPECT_NEAR(fluid::wave_dt<2>(f.nodes(), f.mesh(), Vec<2>(0, -4 * g)), 0.5 * dt, 1e-12 * dt);
    EXPECT_EQ(fluid::wave_dt<2>(f.nodes(), f.mesh(), Vec<2>(0, g)), std::numeric_limits<double>::infinity())
        << "water that hangs has no waves";
  }
}

}  // namespace
}  // namespace splashdown::still_water_test
