// Ratios say nothing where there is nothing below the line.
#include "apps/statistics/verdict/share.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace splashdown::apps::share_test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

TEST(Share, is_told_where_there_is_a_whole_and_a_part_of_it) {
  struct Row {
    double part, whole, noise;
    const char* text;
  };
  for (const auto& [part, whole, noise, text] : std::initializer_list<Row>{{3, 12, 0, "25 %"},
                                                                           {-3, 12, 0, "25 %"},
                                                                           {0.0372, 3, 0, "1.2 %"},
                                                                           {0, 5, 0, "0 %"},
                                                                           {2e-13, 1, 0, "less than 0.1 %"},
                                                                           {5, 5, 0, "100 %"},
                                                                           {3, 12, 13, "no meaningful share"},
                                                                           {41.46, 1, 0, "no meaningful share"},
                                                                           {1e-17, 1e-16, 1e-9, "no meaningful share"},
                                                                           {0, 0, 0, "no meaningful share"},
                                                                           {1, 0, 0, "no meaningful share"},
                                                                           {1, inf, 0, "0 %"},
                                                                           {inf, 1, 0, "no meaningful share"},
                                                                           {nan, 1, 0, "no meaningful share"},
                                                                           {1, nan, 0, "no meaningful share"}})
    EXPECT_EQ(share_text(share_of(part, whole, noise)), text) << part << " of " << whole;
}

TEST(Ratio, may_be_larger_than_one_and_not_without_bound) {
  EXPECT_DOUBLE_EQ(*ratio_of(-3, 2), 1.5);
  EXPECT_FALSE(ratio_of(21, 2));
  EXPECT_FALSE(ratio_of(1, 0));
  EXPECT_FALSE(ratio_of(1, 1e-12, 1e-9));
}

TEST(Share, of_an_impulse_is_none_where_loads_to_and_fro_cancel) {
  BodySummary body;
  body.impulse = {0, 3}, body.impulse_repair = {0, 0.6}, body.impulse_to_and_fro = 3;
  EXPECT_NEAR(repair_share(body).value(), 0.2, 1e-12);
  body.impulse_to_and_fro = 31;
  EXPECT_FALSE(repair_share(body));
}

}  // namespace
}  // namespace splashdown::apps::share_test
