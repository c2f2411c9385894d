// What a paddle sends out, against the expansion in vertical modes that it follows from.
#include "fluid/effects/waves/wavemaker.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace splashdown::fluid {
namespace {

// The paddle's speed U(z) over the depth, taken apart in modes cosh k(d + z) and cosines: the share of the first, whose elevation
// is k/w times its potential. H/S = 2 tanh kd int U cosh / int cosh^2 with U = 1 of S/2 at the still level; d = 1, by Simpson's rule.
double by_modes(Paddle paddle, double k) {
  constexpr int intervals = 2000;
  double speed = 0, mode = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double height = static_cast<double>(i) / intervals, weight = i == 0 || i == intervals ? 1 : i % 2 ? 4 : 2;
    const double cosh =
        (std::exp(k * (height - 1)) + std::exp(-k * (height + 1))) / (1 + std::exp(-2 * k));  // over cosh kd
    speed += weight * (paddle == Paddle::piston ? 1 : height) * cosh;
    mode += weight * cosh * cosh;
  }
  return speed / mode * std::tanh(k);
}

TEST(Wavemaker, has_the_first_mode_of_its_paddle_at_any_depth) {
  for (const double kd : {0.01, 0.1, 0.5, 1.3, 3.0, 10.0, 40.0})
    for (const auto paddle : {Paddle::piston, Paddle::flap})
      EXPECT_NEAR(height_over_stroke(paddle, kd), by_modes(paddle, kd), 1e-6 * by_modes(paddle, kd)) << kd;
}

TEST(Wavemaker, moves_the_water_of_its_stroke_where_it_is_shallow_and_the_surface_where_it_is_deep) {
  constexpr double shallow = 1e-3, deep = 1e3;
  EXPECT_NEAR(height_over_stroke(Paddle::piston, shallow), shallow, shallow * shallow);
  EXPECT_NEAR(height_over_stroke(Paddle::flap, shallow), shallow / 2, shallow * shallow);
  EXPECT_NEAR(height_over_stroke(Paddle::piston, deep), 2, 1e-12);
  EXPECT_NEAR(height_over_stroke(Paddle::flap, deep), 2 * (1 - 1 / deep), 1e-12);
}

}  // namespace
}  // namespace splashdown::fluid
