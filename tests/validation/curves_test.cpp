#include "apps/quantity/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace splashdown::quantity {
namespace {

using Column = std::vector<double>;
constexpr double rounding = 1e-12;  // a few thousand operations on numbers of order one

Column uneven_grid(std::size_t n) {
  Column x;
  for (std::size_t i = 0; i < n; ++i) x.push_back(double(i) / double(n) + 0.3 / double(n) * std::sin(double(i)));
  return x;
}

template <class F>
Column sampled(const Column& x, F f) {
  Column y;
  for (const double place : x) y.push_back(f(place));
  return y;
}

TEST(Curves, slope_of_a_line_is_exact_on_uneven_points) {
  const Column x = uneven_grid(40);
  EXPECT_NEAR(slope(sampled(x, [](double t) { return 3 - 2 * t; }), x), -2, rounding);
}

TEST(Curves, smoothing_leaves_a_parabola_as_it_is) {
  const Column x = uneven_grid(60);
  const Column y = sampled(x, [](double t) { return 1 + 4 * t - 5 * t * t; });
  const Column smooth = smoothed(y, x, 0.2);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(smooth[i], y[i], 1e-9);  // normal equations
}

TEST(Curves, smoothing_takes_out_alternating_noise) {
  const Column x = uneven_grid(400);
  Column y = sampled(x, [](double) { return 1.0; });
  for (std::size_t i = 0; i < y.size(); i += 2) y[i] += 0.1;
  const Column smooth = smoothed(y, x, 0.2);
  for (std::size_t i = 60; i < 340; ++i) EXPECT_NEAR(smooth[i], 1.05, 0.01);
}

TEST(Curves, window_means_of_a_line_are_its_values_in_the_middles) {
  const Column x = {0, 0.3, 0.35, 0.8, 1.0};
  const Column means = window_means(sampled(x, [](double t) { return 2 * t; }), x, 0.25);
  ASSERT_EQ(means.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(means[k], 2 * (0.125 + 0.25 * double(k)), rounding);
}

TEST(Curves, crossings_of_a_sine_are_its_periods) {
  Column x;
  for (int i = 0; i <= 300; ++i) x.push_back(0.01 * i - 0.005);
  const Column y = sampled(x, [](double t) { return std::sin(2 * std::numbers::pi * t); });
  const Column at = upward_crossings(y, x);
  ASSERT_EQ(at.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at[k], double(k), 1e-5);  // chord of a sine over 0.01
}

TEST(Curves, front_that_reaches_a_dry_gauge_is_a_crossing) {
  EXPECT_EQ(upward_crossings({std::nan(""), std::nan(""), 0.1, 0.2}, {0, 1, 2, 3}), Column{2});
}

TEST(Curves, peaks_of_a_parabola_are_exact_between_points) {
  const Column x = {0, 0.3, 0.45, 0.9, 1.2};
  const Column heights = peak_heights(sampled(x, [](double t) { return 7 - (t - 0.5) * (t - 0.5); }), x);
  ASSERT_EQ(heights.size(), 1u);
  EXPECT_NEAR(heights[0], 7, rounding);
}

TEST(Curves, interpolation_is_nan_outside_and_forgives_rounding) {
  const Column y = interpolated({0, 1, 2}, {0, 10, 40}, {1.5, -1e-9, 2.5});
  EXPECT_DOUBLE_EQ(y[0], 25);
  EXPECT_DOUBLE_EQ(y[1], 0);
  EXPECT_TRUE(std::isnan(y[2]));
}

TEST(Curves, decreasing_x_is_refused) {
  EXPECT_THROW(interpolated({0, 2, 1}, {0, 1, 2}, {0.5}), std::runtime_error);
  EXPECT_THROW(integral({1, 1, 1}, {0, 0, 1}), std::runtime_error);
}

// A roof between -1 and 1 is largest over a window of w in its middle, 1 - w/4; points may come in any order.
TEST(Curves, the_largest_mean_is_found_wherever_it_lies) {
  const Column x = {1, 0, -1, 0.5, -0.5, 2}, y = {0, 1, 0, 0.5, 0.5, 0};
  EXPECT_NEAR(largest_mean(y, x, 1e-6), 1, 1e-6);
  EXPECT_NEAR(largest_mean(y, x, 2), 0.5, rounding);
  EXPECT_NEAR(largest_mean({3, 3, 3, 3}, {0, 1, 1, 2}, 2), 3, rounding) << "points at one place";
  EXPECT_TRUE(std::isnan(largest_mean({1, std::nan(""), 1}, {0, 1, 2}, 0.5)));
  EXPECT_THROW(largest_mean(y, x, 3.1), std::runtime_error) << "wider than the points";
}

TEST(Curves, empty_bins_are_nan_and_others_are_means) {
  const Column means = bin_means({1, 3, 5}, {0.1, 0.2, 2.5}, 0, 3, 3);
  EXPECT_DOUBLE_EQ(means[0], 2);
  EXPECT_TRUE(std::isnan(means[1]));
  EXPECT_DOUBLE_EQ(means[2], 5);
  EXPECT_EQ(bin_centres(0, 3, 3), (Column{0.5, 1.5, 2.5}));
}

}  // namespace
}  // namespace splashdown::quantity
