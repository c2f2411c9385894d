#include "core/facet_tree.hpp"

#include <gtest/gtest.h>

#include "core/closest_point.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::facet_tree_test {
namespace {

using scenes::eps;

template <int d>
struct Soup {
  Eigen::Matrix<double, d, Eigen::Dynamic> vertices;
  Eigen::Matrix<int, d, Eigen::Dynamic> facets;
  std::array<Vec<d>, d> corners(int f) const {
    std::array<Vec<d>, d> c;
    for (int k = 0; k < d; ++k) c[k] = vertices.col(facets(k, f));
    return c;
  }
};

template <int d>
Soup<d> soup(int count, std::mt19937& random) {
  Soup<d> s{decltype(Soup<d>::vertices)(d, d * count), decltype(Soup<d>::facets)(d, count)};
  for (int f = 0; f < count; ++f) {
    const Vec<d> at = 10 * scenes::random_vector<Vec<d>>(random, {});
    for (int k = 0; k < d; ++k) {
      s.vertices.col(d * f + k) = at + scenes::random_vector<Vec<d>>(random, {});
      s.facets(k, f) = d * f + k;
    }
  }
  return s;
}

TEST(WeightsIn, are_those_of_the_foot_however_thin_the_facet) {
  for (const double width : {1.0, 1e-3, 1e-6}) {
    const std::array<Vec<3>, 3> facet = {Vec<3>(1, 2, 3), Vec<3>(2, 2.5, 3), Vec<3>(1.5, 2.25 + width, 3)};
    const Vec<3> foot = facet[0] + 0.25 * (facet[1] - facet[0]) + 0.5 * (facet[2] - facet[0]);
    const Vec<2> weights = weights_in(facet, foot + Vec<3>(0, 0, 7));
    // What rounding the corners leaves of a direction across.
    EXPECT_NEAR(weights[0], 0.25, 1e-15 / width + 1e-15);
    EXPECT_NEAR(weights[1], 0.5, 1e-15 / width + 1e-15);
  }
  EXPECT_DOUBLE_EQ(weights_in({Vec<2>(1, 1), Vec<2>(3, 1)}, Vec<2>(1.5, 4))[0], 0.25);
}

TEST(WeightsIn, of_edges_without_length_are_nothing) {
  const Vec<3> a(1, 2, 3), b(2, 2, 3);
  EXPECT_EQ(weights_in({a, a, a}, b), Vec<2>(0, 0));
  EXPECT_EQ(weights_in({a, b, b}, b), Vec<2>(1, 0));
  EXPECT_EQ(weights_in({Vec<2>(1, 1), Vec<2>(1, 1)}, Vec<2>(2, 2))[0], 0);
}

template <class Dimension>
struct FacetTreeIn : testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FacetTreeIn, Dimensions);

TYPED_TEST(FacetTreeIn, no_point_of_a_facet_is_closer_than_the_closest) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(1);
  const auto s = soup<d>(200, random);
  for (int f = 0; f < 200; ++f) {
    const auto corner = s.corners(f);
    const Vec<d> x = corner[0] + 3 * scenes::random_vector<Vec<d>>(random, {});
    const Vec<d> c = closest_on(corner, x);
    // A facet is convex: c is closest if and only if (x - c).(q - c) <= 0 for all corners q.
    for (const auto& q : corner) EXPECT_LE((x - c).dot(q - c), 1e4 * eps);
  }
}

TYPED_TEST(FacetTreeIn, finds_what_looking_at_all_facets_finds) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(2);
  for (int count : {1, 4, 5, 9, 300}) {
    const auto s = soup<d>(count, random);
    const auto elsewhere = soup<d>(count, random);
    const FacetTree<d> made(s.vertices, s.facets),
        came(FacetTree<d>(elsewhere.vertices, s.facets).moved(s.vertices, s.facets));
    for (int sample = 0; sample < 200; ++sample) {
      const auto& tree = sample % 2 == 0 ? made : came;
      const Vec<d> x = 15 * scenes::random_vector<Vec<d>>(random, {});
      double best = std::numeric_limits<double>::max();
      for (int f = 0; f < count; ++f) best = std::min(best, (closest_on(s.corners(f), x) - x).squaredNorm());
      const auto hit = tree.nearest(x, 1e3);
      ASSERT_GE(hit.facet, 0);
      // Corners of the pieces that needles are cut into are rounded: some eps of coordinates below 30.
      const double roundoff = d == 2 ? 0 : 10 * eps * 30 * 30;
      EXPECT_NEAR(hit.squared_distance, best, roundoff);
      EXPECT_NEAR((hit.point - x).squaredNorm(), best, roundoff);
    }
  }
}

// Boxes of single precision, whose roundoff here is as large as the facets.
TYPED_TEST(FacetTreeIn, finds_small_facets_far_from_the_origin) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(5);
  auto s = soup<d>(300, random);
  const Vec<d> there = Vec<d>::Constant(1e7);
  s.vertices = (0.1 * s.vertices).colwise() + there;
  const FacetTree<d> tree(s.vertices, s.facets);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec<d> x = there + 2 * scenes::random_vector<Vec<d>>(random, {});
    double best = std::numeric_limits<double>::max();
    for (int f = 0; f < 300; ++f) best = std::min(best, (closest_on(s.corners(f), x) - x).norm());
    EXPECT_NEAR(std::sqrt(tree.nearest(x, 1e3).squared_distance), best, 100 * eps * there.norm());
  }
}

TEST(FacetTree3, finds_the_first_of_facets_that_are_equally_near) {
  const auto s = scenes::block({-1, -1, -1}, {1, 1, 1});
  const FacetTree<3> tree(s.vertices, s.facets);
  for (int v = 0; v < s.vertices.cols(); ++v) {
    int first = 0;
    while ((s.facets.col(first).array() != v).all()) ++first;
    EXPECT_EQ(tree.nearest(2 * s.vertices.col(v), 9).facet, first) << v;
  }
}

TYPED_TEST(FacetTreeIn, keeps_the_slack_it_is_given) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(4);
  const auto s = soup<d>(300, random);
  const FacetTree<d> tree(s.vertices, s.facets);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec<d> x = 50 * scenes::random_vector<Vec<d>>(random, {});
    const double exact = std::sqrt(tree.nearest(x, 1e3).squared_distance);
    const double loose = std::sqrt(tree.nearest(x, 1e3, 0.02).squared_distance);
    EXPECT_GE(loose, exact);
    EXPECT_LE(loose, 1.02 * exact * (1 + eps));
  }
}

TYPED_TEST(FacetTreeIn, finds_nothing_beyond_its_reach) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(3);
  const auto s = soup<d>(50, random);
  const FacetTree<d> tree(s.vertices, s.facets);
  for (int sample = 0; sample < 100; ++sample) {
    const Vec<d> x = 20 * scenes::random_vector<Vec<d>>(random, {});
    const double distance = std::sqrt(tree.nearest(x, 1e3).squared_distance);
    EXPECT_LT(tree.nearest(x, distance * (1 - 1e-9)).facet, 0);
    EXPECT_GE(tree.nearest(x, distance * (1 + 1e-9)).facet, 0);
  }
}

TYPED_TEST(FacetTreeIn, finds_the_facets_that_meet_a_box) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(6);
  const auto s = soup<d>(80, random);
  const FacetTree<d> tree(s.vertices, s.facets);
  for (int sample = 0; sample < 50; ++sample) {
    typename FacetTree<d>::Box box(scenes::random_vector<Vec<d>>(random, {}));
    box.extend(scenes::random_vector<Vec<d>>(random, {}));
    const auto found = tree.meeting(box);
    EXPECT_TRUE(std::ranges::is_sorted(found));
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
    for (int f = 0; f < 80; ++f) {
      typename FacetTree<d>::Box facet;
      for (const auto& corner : s.corners(f)) {
        facet.extend(corner);
        if (box.contains(corner)) {
          EXPECT_TRUE(std::ranges::binary_search(found, f));
        }
      }
      if (!facet.intersects(box)) {
        EXPECT_FALSE(std::ranges::binary_search(found, f));
      }
    }
  }
  EXPECT_TRUE(FacetTree<d>().meeting({Vec<d>::Zero(), Vec<d>::Ones()}).empty());
}

TYPED_TEST(FacetTreeIn, an_empty_tree_has_nothing_near) {
  constexpr int d = TypeParam::value;
  const FacetTree<d> tree;
  EXPECT_TRUE(tree.empty());
  EXPECT_LT(tree.nearest(Vec<d>::Zero(), 1).facet, 0);
}

TYPED_TEST(FacetTreeIn, many_equal_facets_do_no_harm) {
  constexpr int d = TypeParam::value;
  std::mt19937 random(4);
  auto s = soup<d>(1, random);
  s.facets = s.facets.replicate(1, 1000).eval();
  const FacetTree<d> tree(s.vertices, s.facets);
  const Vec<d> x = Vec<d>::Constant(3);
  EXPECT_EQ(tree.nearest(x, 1e3).squared_distance, (closest_on(s.corners(0), x) - x).squaredNorm());
}

}  // namespace
}  // namespace splashdown::fluid::facet_tree_test
