#include "apps/statistics/pulse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/statistics/statistics.hpp"

namespace splashdown::apps::pulse_test {
namespace {

constexpr double height = 100, width = 0.02, start = 0.05, step = 1e-5;
const std::array along{0.6, -0.8};

/// A half sine after free fall across its direction at first and against it at last.
double sine_at(double t) {
  return t > start && t < start + width ? height * std::sin(std::numbers::pi * (t - start) / width) : 0;
}

IntervalHistory landing() {
  IntervalHistory history{2, 0, {}, {}};
  for (int i = 0; i < 15000; ++i) {
    const double t = (i + 0.5) * step, a = sine_at(t), fall = t < start ? 9.81 : 0;
    history.append((i + 1) * step, std::array{along[0] * a, along[1] * a + fall});
  }
  return history;
}

// c = h sin(pi t / w): the levels are met at w/pi asin(level). Linear crossings of a curve of slope s and curvature k
// err by k dt^2 / 8 s < 1e-9 s; staircase values err by one kick in begin and end at most.
TEST(Pulse, of_a_half_sine_after_free_fall_has_its_rise_time_duration_and_change) {
  const Pulse pulse = pulse_of(landing());
  const double to_tenth = std::asin(0.1) * width / std::numbers::pi,
               to_nine = std::asin(0.9) * width / std::numbers::pi;
  EXPECT_NEAR(pulse.value, height, 1e-4);
  EXPECT_NEAR(pulse.time, start + width / 2, step);
  EXPECT_NEAR(pulse.begin, start + to_tenth, 1e-7);
  EXPECT_NEAR(pulse.rise_time, to_nine - to_tenth, 1e-7);
  EXPECT_NEAR(pulse.duration, width - 2 * to_tenth, 1e-7);
  // int h sin = 2 h w / pi cos(pi t_10 / w), the foot's intervals are cut where the line crosses: h/10 dt at most.
  EXPECT_NEAR(pulse.change, 2 * height * width / std::numbers::pi * std::cos(std::asin(0.1)), 0.1 * height * step);
}

// The change is the integral of the interval averages, whatever their lengths: v(end) - v(begin) of the motion.
TEST(Pulse, change_is_the_difference_of_velocity) {
  const auto v = [](double t) {
    return height * width / std::numbers::pi * (1 - std::cos(std::numbers::pi * t / width));
  };
  IntervalHistory history{1, 0, {0.01}, {0.0}};
  double t = 0;
  for (int i = 0; t < width; ++i) {
    const double next = std::min(width, t + 1e-5 * (1 + i % 7));
    history.append(0.01 + next, std::array{(v(next) - v(t)) / (next - t)});
    t = next;
  }
  history.append(0.04, std::array{0.0});
  const Pulse pulse = pulse_of(history);
  const double begin = std::asin(0.1) * width / std::numbers::pi;
  EXPECT_NEAR(pulse.change, v(width - begin) - v(begin), 1e-9 * v(width) + 0.1 * height * 7e-5);
}

// The gain is one at frequency zero: the integral of a filtered record that is at rest at its ends is that of the raw one.
TEST(Cfc, keeps_the_velocity_change) {
  IntervalHistory pulse{1, 0, {}, {}};
  for (int i = 0; i < 20000; ++i) pulse.append((i + 1) * step, std::array{sine_at((i + 0.5) * step)});
  for (const int cfc : channel_frequency_classes) {
    const auto filtered_pulse = filtered(pulse, cfc);
    ASSERT_TRUE(filtered_pulse);
    double change = 0, begin = filtered_pulse->begin;
    for (std::size_t i = 0; i < filtered_pulse->ends.size(); ++i) {
      change += filtered_pulse->values[i] * (filtered_pulse->ends[i] - begin);
      begin = filtered_pulse->ends[i];
    }
    // Rounding of the recursion, 1.5e-11 a sample of the constant part (filters_test), and what the response leaves
    // outside the record after 50 ms = 3 periods of CFC 60: 1e-4 each.
    EXPECT_NEAR(change, 2 * height * width / std::numbers::pi, 1e-6 * height * width) << cfc;
  }
}

// A scene that begins at the instant of contact: what the filter spreads ahead of it is part of the pulse.
TEST(Cfc, a_pulse_at_the_start_of_the_record_has_its_foot_in_the_margin) {
  IntervalHistory history{1, 0, {}, {}};
  for (int i = 0; i < 20000; ++i) history.append((i + 1) * step, std::array{sine_at(start + (i + 0.5) * step)});
  const auto pulses = filtered_pulses(history);
  for (const int cfc : channel_frequency_classes) {
    ASSERT_TRUE(pulses.contains(cfc));
    // A half sine of 25 Hz far below each class: what it spreads is less than a period of the class.
    EXPECT_NEAR(pulses.at(cfc).duration, width * (1 - 2 * std::asin(0.1) / std::numbers::pi), 1.0 / cfc) << cfc;
    EXPECT_GT(pulses.at(cfc).rise_time, 0);
  }
}

TEST(Pulse, what_the_record_does_not_show_is_not_a_number) {
  const Pulse falling = pulse_of({1, 0, {1, 2, 3}, {5, 2, 0}});
  EXPECT_EQ(falling.value, 5);
  EXPECT_TRUE(std::isnan(falling.rise_time));
  EXPECT_TRUE(std::isnan(falling.duration));
  const Pulse rising = pulse_of({1, 0, {1, 2, 3}, {0, 2, 5}});
  EXPECT_TRUE(std::isfinite(rising.rise_time));
  EXPECT_TRUE(std::isnan(rising.duration));
  EXPECT_LT(pulse_of({}).time, 0);
  EXPECT_EQ(pulse_of({1, 0, {1, 2}, {0, 0}}).value, 0);
}

// A second, lower hump belongs to the pulse only if the channel stays above a tenth in between.
TEST(Pulse, ends_where_the_channel_first_falls_below_a_tenth) {
  const Pulse pulse = pulse_of({1, 0, {1, 2, 3, 4, 5, 6, 7}, {0, 10, 2, 10, 0, 5, 0}});
  EXPECT_NEAR(pulse.duration, 4.4 - 0.6, 1e-12);  // crossings of 1: 0.5 + 0.1 and 3.5 + 0.9
  EXPECT_NEAR(pulse.change, 10 + 2 + 10, 1e-12);
}

TEST(PulseStatistics, peak_is_in_the_unit_and_the_change_is_not) {
  PulseStatistics statistics;
  for (int i = 0; i < 3; ++i) {
    const double a = i == 1 ? standard_gravity : 0;
    statistics.add({i + 0.5, i + 0.0, i + 1.0}, {&a, 1});
  }
  const auto summary = statistics.summary(standard_gravity);
  EXPECT_DOUBLE_EQ(summary.raw.value, 1);
  EXPECT_EQ(summary.raw.time, 1.5);
  EXPECT_NEAR(summary.raw.change, standard_gravity, 1e-12);
}

}  // namespace
}  // namespace splashdown::apps::pulse_test
