#include "fluid/pfem/mesh/conservation/shares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::shares_test {
namespace {

template <class D>
class Shares : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Shares, Dimensions);

constexpr double size = 10;

/// Places all over a box of this size.
template <int d>
std::vector<SurfacePlace<d>> places() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> room(0.5, 2);
  std::vector<SurfacePlace<d>> list;
  for (int k = 0; k < 300; ++k) list.push_back({size * scenes::random_vector<Vec<d>>(random, {}), room(random)});
  return list;
}

template <int d>
double whole(const std::vector<SurfacePlace<d>>& list) {
  double sum = 0;
  for (const auto& place : list) sum += place.room;
  return sum;
}

template <int d>
Vec<d> mean_place(const std::vector<SurfacePlace<d>>& list, const std::vector<double>& shares) {
  Vec<d> sum = Vec<d>::Zero();
  for (std::size_t i = 0; i < list.size(); ++i) sum += shares[i] * list[i].room * list[i].x;
  return sum / whole<d>(list);
}

TYPED_TEST(Shares, are_positive_and_one_in_the_mean_by_room) {
  constexpr int d = TypeParam::value;
  const auto list = places<d>();
  for (const double far : {0., 0.3, 1., 100.}) {
    const auto shares = shares_about<d>(Vec<d>::Constant(far * size), list);
    double sum = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      EXPECT_GT(shares[i], 0);
      sum += shares[i] * list[i].room;
    }
    EXPECT_NEAR(sum, whole<d>(list), 1e3 * scenes::eps * sum) << far;
  }
}

TYPED_TEST(Shares, have_their_mean_where_the_volume_was_lost) {
  constexpr int d = TypeParam::value;
  const auto list = places<d>();
  for (const Vec<d>& at : {Vec<d>(Vec<d>::Constant(0.2 * size)), Vec<d>(-0.5 * size * Vec<d>::Unit(d - 1))}) {
    // But for e a L: with a box of side s filled evenly the mean moves by a s^2 / 12 L, and L^2 = d s^2.
    const double off = (mean_place<d>(list, shares_about<d>(at, list)) - at).norm(), e = 0.01;
    EXPECT_LT(off, 12 * d * e * at.norm());
  }
}

TYPED_TEST(Shares, are_equal_where_equal_ones_do) {
  constexpr int d = TypeParam::value;
  const auto list = places<d>();
  const auto centre = mean_place<d>(list, std::vector<double>(list.size(), 1.0));
  for (const double share : shares_about<d>(centre, list)) EXPECT_NEAR(share, 1, 1e3 * scenes::eps);
}

TYPED_TEST(Shares, go_to_the_near_end_where_the_surface_does_not_reach_so_far) {
  constexpr int d = TypeParam::value;
  const std::vector<SurfacePlace<d>> two{{Vec<d>::Zero(), 1}, {Vec<d>::Unit(0), 1}};
  const auto shares = shares_about<d>(-5 * Vec<d>::Unit(0), two);
  EXPECT_GT(shares[0], 1.9);
  EXPECT_GT(shares[1], 0);
}

TYPED_TEST(Shares, of_one_place_or_of_places_that_coincide_are_equal) {
  constexpr int d = TypeParam::value;
  const std::vector<SurfacePlace<d>> three(3, {Vec<d>::Ones(), 1});
  EXPECT_EQ(shares_about<d>(Vec<d>::Zero(), three), std::vector<double>(3, 1.0));
  EXPECT_EQ(shares_about<d>(Vec<d>::Zero(), std::span(three).first(1)), std::vector<double>(1, 1.0));
}

}  // namespace
}  // namespace splashdown::fluid::shares_test
