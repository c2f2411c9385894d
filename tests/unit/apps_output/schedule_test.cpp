#include "apps/record/schedule.hpp"

#include <gtest/gtest.h>

namespace splashdown::apps::schedule_test {
namespace {

TEST(Schedule, without_an_interval_each_step_is_due) {
  Schedule schedule(0.0);
  for (const double t : {0.0, 1e-9, 0.3}) EXPECT_TRUE(schedule.due(t));
}

TEST(Schedule, each_multiple_is_met_once_by_the_first_step_at_or_after_it) {
  Schedule schedule(0.1);
  EXPECT_TRUE(schedule.due(0));
  EXPECT_FALSE(schedule.due(0.06));
  EXPECT_TRUE(schedule.due(0.12));
  EXPECT_FALSE(schedule.due(0.18));
  EXPECT_TRUE(schedule.due(0.2));
}

TEST(Schedule, a_long_step_over_several_multiples_is_due_once) {
  Schedule schedule(0.1);
  EXPECT_TRUE(schedule.due(0));
  EXPECT_TRUE(schedule.due(0.55));
  EXPECT_FALSE(schedule.due(0.58));
  EXPECT_TRUE(schedule.due(0.6));
}

// A sum of steps that aims at k * interval misses it by k roundings.
TEST(Schedule, rounding_of_a_summed_time_misses_no_multiple) {
  Schedule schedule(0.001);
  int due = 0;
  double t = 0;
  for (int i = 0; i <= 10000; ++i, t += 0.0001) due += schedule.due(t) ? 1 : 0;
  EXPECT_EQ(due, 1001);
}

TEST(Schedule, listed_times_are_each_met_by_the_first_step_at_or_after_them) {
  Schedule schedule(std::vector<double>{0.1, 0.15, 0.4});
  EXPECT_FALSE(schedule.due(0));
  EXPECT_TRUE(schedule.due(0.2));
  EXPECT_FALSE(schedule.due(0.3));
  EXPECT_TRUE(schedule.due(0.4));
  EXPECT_FALSE(schedule.due(0.5));
}

}  // namespace
}  // namespace splashdown::apps::schedule_test
