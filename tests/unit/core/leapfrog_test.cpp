#include "core/leapfrog.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/types.hpp"

namespace splashdown::leapfrog_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(Leapfrog, kicks_end_where_the_next_ones_begin) {
  // From the middle of one step to the middle of the next: kicks of all steps are the time but for half of the first and the last.
  const double dt[] = {0.3, 0.1, 0.25, 0.7};
  double kicks = 0, time = 0;
  for (int n = 1; n < 4; ++n) kicks += kick(dt[n - 1], dt[n]);
  for (const double step : dt) time += step;
  EXPECT_NEAR(kicks, time - 0.5 * (dt[0] + dt[3]), 4 * eps);
  EXPECT_EQ(kick(0, 0.2), 0.1) << "a run begins at t_0: half a kick";
}

TEST(Leapfrog, velocities_that_are_linear_in_time_are_exact_at_t_n) {
  const Vec<3> v_0(1, -2, 3), a(0.5, 4, -7);
  const double t = 1.3, dt_before = 0.4, dt = 0.1;
  const auto at = [&](double time) -> Vec<3> { return v_0 + time * a; };
  const Vec<3> found = velocity_at_t_n<Vec<3>>(at(t - dt_before / 2), at(t + dt / 2), dt_before, dt);
  EXPECT_LE((found - at(t)).norm(), 4 * eps * at(t).norm());
  EXPECT_EQ((velocity_at_t_n<Vec<3>>(v_0, a, 0, dt)), v_0) << "the first step begins with the initial velocity";
}

}  // namespace
}  // namespace splashdown::leapfrog_test
