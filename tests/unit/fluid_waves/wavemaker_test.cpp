// What a paddle sends out, against the expansion in vertical modes that it follows from.
#include "fluid/effects/waves/wavemaker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fluid/effects/waves/dispersion.hpp"

namespace splashdown::fluid::wavemaker_test {
namespace {

// The paddle's speed U(z) over the depth, taken apart in modes cosh k(d + z) and cosines: the share of the first, whose elevation
// is k/w times its potential. H/S = 2 tanh kd int U cosh / int cosh^2 with U = 1 of S/2 at the still level; d = 1, by Simpson's rule.
double by_modes(Paddle paddle, double k, double hinge = 0) {
  constexpr int intervals = 2000;
  double speed = 0, mode = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double height = static_cast<double>(i) / intervals, weight = i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2;
    const double cosh =
        (std::exp(k * (height - 1)) + std::exp(-k * (height + 1))) / (1 + std::exp(-2 * k));  // over cosh kd
    const double swings = std::max(height - hinge, 0.) / (1 - hinge);
    speed += weight * (paddle == Paddle::piston ? 1 : swings) * cosh;
    mode += weight * cosh * cosh;
  }
  return speed / mode * std::tanh(k);
}

TEST(Wavemaker, has_the_first_mode_of_its_paddle_at_any_depth) {
  for (const double kd : {0.01, 0.1, 0.5, 1.3, 3.0, 10.0, 40.0})
    for (const auto paddle : {Paddle::piston, Paddle::flap})
      EXPECT_NEAR(height_over_stroke(paddle, kd), by_modes(paddle, kd), 1e-6 * by_modes(paddle, kd)) << kd;
}

TEST(Wavemaker, has_the_first_mode_of_a_flap_above_a_sill) {
  for (const double kd : {0.1, 1.3, 3.0, 10.0})
    for (const double hinge : {0.2, 0.5, 0.8}) {  // on a node of the rule
      const double modes = by_modes(Paddle::flap, kd, hinge);
      EXPECT_NEAR(height_over_stroke(Paddle::flap, kd, hinge), modes, 1e-6 * modes) << kd << ", " << hinge;
    }
  // A hinge at the still level moves nothing; in deep water waves do not reach down to it.
  EXPECT_LT(height_over_stroke(Paddle::flap, 1, 0.999), 1.1 * by_modes(Paddle::piston, 1) * 1e-3);
  EXPECT_NEAR(height_over_stroke(Paddle::flap, 1e3, 0.5), 2 * (1 - 1 / (1e3 * 0.5)), 1e-9);
}

TEST(Wavemaker, sends_a_sea_whose_waves_have_their_crests_where_the_paddle_is_fastest) {
  const std::vector<SeaWave> waves{{0.03, 5, 0, 0.4}};
  const PaddleSpec spec{.type = Paddle::piston, .depth = 0.4};
  const PaddleSea sea(waves, spec);
  const double k = wave_number(5, 0.4, spec.gravity), half = 0.03 / height_over_stroke(Paddle::piston, k * 0.4);
  const double fastest = 0.4 / 5, eps = 1e-4;
  EXPECT_NEAR(sea.displacement(fastest), 0, 1e-15);
  EXPECT_NEAR((sea.displacement(fastest + eps) - sea.displacement(fastest - eps)) / (2 * eps), half * 5, 1e-6);
  EXPECT_NEAR(sea.elevation(0, fastest), 0.03, 1e-15);
  const double later = 20 * std::numbers::pi / 5;  // ten periods: the energy is there
  EXPECT_NEAR(sea.elevation(2, fastest + 2 * k / 5 + later), 0.03, 1e-14) << "the crest runs on with w/k";
  EXPECT_EQ(sea.elevation(2, fastest + 2 * k / 5), 0) << "before its energy";
}

TEST(Wavemaker, sea_grows_at_the_paddle_and_later_farther_away) {
  const SpectrumSpec spectrum{.significant_height = 0.05, .peak_period = 1.2};
  const PaddleSpec still{.type = Paddle::flap, .hinge = 0.1, .depth = 0.4, .ramp = 2.4};
  const auto waves = sea_waves(spectrum);
  const PaddleSea sea(waves, still);
  EXPECT_EQ(sea.displacement(0), 0);
  EXPECT_EQ(sea.elevation(5, 1), 0) << "no wave is as fast as 5 m/s";
  PaddleSpec grown = still;
  grown.ramp = 0;
  for (const double t : {2.5, 7.0, 30.0}) EXPECT_EQ(sea.displacement(t), PaddleSea(waves, grown).displacement(t)) << t;
  // Four standard deviations over the time after which it repeats itself.
  double squares = 0;
  constexpr int samples = 4000;
  const double repeats = spectrum.repeat * spectrum.peak_period;
  for (int i = 0; i < samples; ++i) squares += std::pow(sea.elevation(3, repeats * (1 + i / double(samples))), 2);
  EXPECT_NEAR(4 * std::sqrt(squares / samples), spectrum.significant_height, 1e-9);
}

TEST(Wavemaker, moves_the_water_of_its_stroke_where_it_is_shallow_and_the_surface_where_it_is_deep) {
  constexpr double shallow = 1e-3, deep = 1e3;
  EXPECT_NEAR(height_over_stroke(Paddle::piston, shallow), shallow, shallow * shallow);
  EXPECT_NEAR(height_over_stroke(Paddle::flap, shallow), shallow / 2, shallow * shallow);
  EXPECT_NEAR(height_over_stroke(Paddle::piston, deep), 2, 1e-12);
  EXPECT_NEAR(height_over_stroke(Paddle::flap, deep), 2 * (1 - 1 / deep), 1e-12);
}

}  // namespace
}  // namespace splashdown::fluid::wavemaker_test
