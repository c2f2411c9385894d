#include "apps/quantity/signals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace splashdown::quantity {
namespace {

using Column = std::vector<double>;
constexpr double turn = 2 * std::numbers::pi;

/// A tone of 40 Hz with a bell of width 0.05 s about `packet`, crest at `crest`; 0 to 1 s.
struct Bell {
  Column t, y;
  Bell(double packet, double crest) {
    for (int i = 0; i <= 2000; ++i) {
      t.push_back(i / 2000.);
      y.push_back(std::exp(-std::pow((t.back() - packet) / 0.05, 2)) * std::cos(turn * 40 * (t.back() - crest)));
    }
  }
};

TEST(Signals, lag_is_the_phase_of_crests_and_delay_the_time_of_the_packet) {
  const Bell bell(0.4, 0.405);
  EXPECT_NEAR(lag(bell.y, bell.t, 40), std::fmod(turn * 40 * 0.405, turn), 1e-9);
  EXPECT_NEAR(delay(bell.y, bell.t, 40), 0.4, 1e-9);
}

TEST(Signals, envelope_is_the_bell_and_arrives_at_half_of_it) {
  const Bell bell(0.4, 0.405);
  const Column heights = envelope(bell.y, bell.t);
  for (std::size_t i = 0; i < bell.t.size(); ++i)
    EXPECT_NEAR(heights[i], std::exp(-std::pow((bell.t[i] - 0.4) / 0.05, 2)), 1e-6);
  // exp(-s^2) = 1/2; linear between steps of 0.5 ms.
  EXPECT_NEAR(arrival(bell.y, bell.t), 0.4 - 0.05 * std::sqrt(std::log(2.)), 1e-5);
}

TEST(Signals, arrival_does_not_see_the_sign_nor_the_unit) {
  const Bell bell(0.4, 0.405);
  Column other = bell.y;
  for (double& value : other) value *= -1e9;
  EXPECT_NEAR(arrival(other, bell.t), arrival(bell.y, bell.t), 1e-12);
}

TEST(Signals, nan_is_never_hidden) {
  Bell bell(0.4, 0.4);
  bell.y[3] = std::nan("");
  EXPECT_TRUE(std::isnan(lag(bell.y, bell.t, 40)));
  EXPECT_TRUE(std::isnan(delay(bell.y, bell.t, 40)));
  EXPECT_TRUE(std::isnan(arrival(bell.y, bell.t)));
}

}  // namespace
}  // namespace splashdown::quantity
