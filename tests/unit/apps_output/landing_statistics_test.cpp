#include "apps/statistics/landing_statistics.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace splashdown::apps::landing_statistics_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

Eigen::Matrix3d turned(double roll, double pitch, double heading) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(heading * degree, Vector3d::UnitZ()) * AngleAxisd(-pitch * degree, Vector3d::UnitY()) *
          AngleAxisd(roll * degree, Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(Attitude, reads_back_the_angles_a_body_was_turned_by) {
  for (const double roll : {-170., -30., 0., 85.})
    for (const double pitch : {-80., 0., 8., 60.})
      for (const double heading : {-120., 0., 37., 179.}) {
        const auto angles = attitude_deg<3>(turned(roll, pitch, heading));
        EXPECT_NEAR(angles[0], roll, 1e-10);
        EXPECT_NEAR(angles[1], pitch, 1e-10);
        EXPECT_NEAR(angles[2], heading, 1e-10);
      }
  EXPECT_NEAR(attitude_deg<3>(turned(0, 8, 0))[1], 8, 1e-12);
  EXPECT_GT((turned(0, 8, 0) * Eigen::Vector3d::UnitX()).z(), 0) << "nose up";
  EXPECT_NEAR(attitude_deg<2>(Eigen::Rotation2Dd(-0.5).toRotationMatrix())[1], -0.5 / degree, 1e-12);
}

TEST(Attitude, tilt_is_the_angle_between_up_and_up_whatever_the_heading) {
  EXPECT_NEAR(tilt_deg<3>(turned(0, 30, 77)), 30, 1e-12);
  EXPECT_NEAR(tilt_deg<3>(turned(150, 0, -20)), 150, 1e-12);
  EXPECT_NEAR(tilt_deg<3>(turned(1e-6, 0, 0)), 1e-6, 1e-18 / 1e-6);
  EXPECT_NEAR(tilt_deg<2>(Eigen::Rotation2Dd(2).toRotationMatrix()), 2 / degree, 1e-12);
}

/// Heave that dies out, z' = v0 exp(-t / T) cos(2 pi t), from contact at t = 1 on.
LandingReading<2> heave(double t) {
  LandingReading<2> reading{Eigen::Matrix2d::Identity(), Twist<2>::Zero(), t < 1 ? 0 : 0.5};
  const double s = t - 1;
  reading.velocity(1) = s < 0 ? -3 : -3 * std::exp(-s) * std::cos(2 * std::numbers::pi * s);
  reading.velocity(0) = 2;  // drifts on for ever
  return reading;
}

TEST(Settling, is_the_last_time_the_speed_exceeds_the_threshold_plus_a_step) {
  const HullExtent extent{0.3, 0.5};
  LandingStatistics<2> landing;
  const double dt = 1e-3, below = 0.02 * std::sqrt(standard_gravity * extent.length);
  double last_above = 0;
  for (int n = 0; n <= 8000; ++n) {
    const double t = n * dt;
    if (t >= 1 && std::abs(heave(t).velocity(1)) >= below) last_above = t;
    landing.add(t, heave(t), extent);
  }
  const auto summary = landing.summary();
  EXPECT_NEAR(summary.settled_below, below, 1e-15);
  EXPECT_NEAR(summary.settled, last_above + dt, 1e-9);
  EXPECT_GT(summary.settled, 1 + std::log(3 / below) - 1) << "within a period of the envelope";
}

// At the turning point of a swing the speed is small, too.
TEST(Settling, is_not_seen_before_a_period_has_passed) {
  LandingStatistics<2> landing;
  const HullExtent extent{0.3, 0.5};
  for (int n = 0; n <= 1249; ++n) landing.add(n * 1e-3, heave(n * 1e-3), extent);  // cos(2 pi 0.249) = 0.006
  EXPECT_LT(landing.summary().settled, 0);
}

TEST(Settling, counts_roll_and_pitch_but_no_yaw) {
  const HullExtent extent{0.5, 1};
  const auto settled_with = [&](const Eigen::Vector3d& spin) {
    LandingStatistics<3> landing;
    LandingReading<3> reading{Eigen::Matrix3d::Identity(), Twist<3>::Zero(), 1};
    reading.velocity.tail<3>() = spin;
    for (int n = 0; n <= 300; ++n) landing.add(n * 0.01, reading, extent);
    return landing.summary().settled;
  };
  EXPECT_EQ(settled_with({0, 0, 5}), 0);
  EXPECT_LT(settled_with({0.5, 0, 0}), 0);
  EXPECT_LT(settled_with({0, 0.5, 0}), 0);
}

/// Rolls over at 10 deg/s from t = 0 until `until`, then back at the same rate.
LandingSummary roll(double until, double end) {
  LandingStatistics<3> landing;
  for (int n = 0; n * 0.1 <= end + 1e-9; ++n) {
    const double t = n * 0.1, angle = 10 * (t < until ? t : 2 * until - t);
    landing.add(t, {turned(angle, 0, 37), Twist<3>::Zero(), 1}, {1, 1});
  }
  return landing.summary();
}

TEST(Capsizing, is_a_tilt_beyond_ninety_degrees_that_lasts_until_the_end) {
  const auto over = roll(100, 25);              // 250 degrees: on its way up again
  EXPECT_NEAR(over.capsized_since, 9.1, 1e-9);  // the first step beyond 9 s
  EXPECT_NEAR(over.maximum_tilt.value, 180, 1e-9);
  EXPECT_NEAR(over.attitude[0].second.end, 250, 1e-9) << "no jump at 180 degrees";
  EXPECT_NEAR(over.attitude[2].second.end, 37, 1e-9);
  EXPECT_LT(roll(8, 12).capsized_since, 0);
  EXPECT_LT(roll(12, 20).capsized_since, 0) << "came back";
  EXPECT_NEAR(roll(8, 12).attitude[0].second.highest.value, 80, 1e-9);
}

TEST(Skips, are_the_dry_intervals_after_first_contact) {
  LandingStatistics<2> landing;
  //                      0  1  2  3  4  5  6  7  8
  const double wetted[] = {0, 0, 1, 1, 0, 0, 1, 2, 0};
  for (int n = 0; n < 9; ++n) landing.add(n, {Eigen::Matrix2d::Identity(), Twist<2>::Zero(), wetted[n]}, {1, 1});
  const auto summary = landing.summary();
  EXPECT_EQ(summary.first_contact, 2);
  ASSERT_EQ(summary.dry_intervals.size(), 2u);
  EXPECT_EQ(summary.dry_intervals[0], (std::array<double, 2>{4, 6}));
  EXPECT_EQ(summary.dry_intervals[1][0], 8);
  EXPECT_LT(summary.dry_intervals[1][1], 0);
}

TEST(Landing, a_body_that_stays_dry_has_landed_in_no_way) {
  LandingStatistics<2> landing;
  for (int n = 0; n < 9; ++n) landing.add(n, {Eigen::Matrix2d::Identity(), Twist<2>::Zero(), 0.0}, {1, 1});
  const auto summary = landing.summary();
  EXPECT_LT(summary.first_contact, 0);
  EXPECT_LT(summary.settled, 0);
  EXPECT_TRUE(summary.dry_intervals.empty());
}

}  // namespace
}  // namespace splashdown::apps::landing_statistics_test
