#include "fluid/wall.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid {
namespace {

using scenes::eps;
using scenes::outline;

const Isometry<2> at_home = Isometry<2>::Identity();

Isometry<2> somewhere() {
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translate(Vec<2>(3, -2));
  pose.rotate(0.7);
  return pose;
}

// Sum of the angles under which the facets are seen: 2 pi inside, 0 outside.
bool encloses(const Surface<2>& s, const Vec<2>& x) {
  double angle = 0;
  for (int f = 0; f < s.facets.cols(); ++f) {
    const Vec<2> a = Vec<2>(s.vertices.col(s.facets(0, f))) - x,
                 b = Vec<2>(s.vertices.col(s.facets(1, f))) - x;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(angle) > std::numbers::pi;
}

double distance_by_all(const Surface<2>& s, const Vec<2>& x) {
  double best = 1e300;
  for (int f = 0; f < s.facets.cols(); ++f)
    best = std::min(
        best,
        (closest_on({Vec<2>(s.vertices.col(s.facets(0, f))), Vec<2>(s.vertices.col(s.facets(1, f)))}, x) - x)
            .norm());
  return best;
}

Surface<2> letter_l() { return outline({{-2, -2}, {2, -2}, {2, -1}, {-1, -1}, {-1, 2}, {-2, 2}}); }
Surface<2> arrow() { return outline({{0, 0}, {2, 2}, {-2, 0}, {2, -2}}); }  // two spikes and a deep notch
Surface<2> blade() { return outline({{-2, 0}, {2, -1e-2}, {2, 1e-2}}); }

struct Sided : testing::TestWithParam<int> {
  static Surface<2> shape(int i) {
    return std::array{letter_l(), arrow(), blade(), scenes::ellipse(1, 2, 64)}[i];
  }
};

TEST_P(Sided, a_point_in_the_solid_has_a_negative_distance_and_no_other) {
  const auto surface = shape(GetParam());
  const Wall<2> body(scenes::wall("body", surface, 1));
  const Wall<2> tank(scenes::wall("tank", scenes::turned_inside_out(surface), 1));
  std::mt19937 random(7);
  for (int sample = 0; sample < 4000; ++sample) {
    const Vec<2> x = 2.5 * scenes::random_vector<Vec<2>>(random, {});
    const double distance = distance_by_all(surface, x);
    if (distance < 1e-9) continue;
    const double side = encloses(surface, x) ? -1 : 1;
    EXPECT_NEAR(body.nearest(at_home, x, 100).distance, side * distance, 20 * eps) << x.transpose();
    EXPECT_NEAR(tank.nearest(at_home, x, 100).distance, -side * distance, 20 * eps) << x.transpose();
    EXPECT_NEAR(body.distance_unsigned(at_home, x, 100), distance, 20 * eps);
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, Sided, testing::Range(0, 4));

TEST(WallNearest, goes_with_the_pose) {
  const Wall<2> wall(scenes::wall("l", letter_l(), 1));
  std::mt19937 random(8);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec<2> x = 3 * scenes::random_vector<Vec<2>>(random, {});
    const auto here = wall.nearest(at_home, x, 100), there = wall.nearest(somewhere(), somewhere() * x, 100);
    EXPECT_NEAR(here.distance, there.distance, 50 * eps);
    EXPECT_LE((somewhere() * here.point - there.point).norm(), 50 * eps);
    EXPECT_EQ(here.patch, there.patch);
    EXPECT_EQ(here.vertex, there.vertex);
    EXPECT_LE((somewhere().linear() * here.normal - there.normal).norm(), 50 * eps);
  }
}

TEST(WallNearest, beyond_reach_is_reach) {
  const Wall<2> wall(scenes::wall("l", letter_l(), 1));
  const auto near = wall.nearest(at_home, {10, 10}, 0.5);
  EXPECT_EQ(near.distance, 0.5);
  EXPECT_EQ(near.patch, -1);
  EXPECT_EQ(near.vertex, -1);
}

TEST(WallCreases, above_thirty_degrees_are_sharp) {
  EXPECT_EQ(Wall<2>(scenes::wall("square", scenes::rectangle({0, 0}, {1, 1}), 1)).sharp_vertices().size(),
            4u);
  EXPECT_EQ(Wall<2>(scenes::wall("circle", scenes::ellipse(1, 1, 64), 1)).sharp_vertices().size(), 0u);
  EXPECT_EQ(Wall<2>(scenes::wall("dodecagon+", scenes::ellipse(1, 1, 13), 1)).sharp_vertices().size(), 0u);
  EXPECT_EQ(Wall<2>(scenes::wall("hendecagon", scenes::ellipse(1, 1, 11), 1)).sharp_vertices().size(), 11u);
}

TEST(WallCreases, divide_the_surface_into_smooth_patches) {
  const auto patches = [](const Surface<2>& s) {
    const Wall<2> wall(scenes::wall("", s, 1));
    std::set<int> found;
    for (int f = 0; f < s.facets.cols(); ++f) {
      const Vec<2> middle = 0.5 * (s.vertices.col(s.facets(0, f)) + s.vertices.col(s.facets(1, f)));
      found.insert(wall.nearest(Isometry<2>::Identity(), middle, 1).patch);
    }
    return found.size();
  };
  EXPECT_EQ(patches(scenes::rectangle({0, 0}, {1, 1})), 4u);
  EXPECT_EQ(patches(letter_l()), 6u);
  EXPECT_EQ(patches(scenes::ellipse(1, 1, 64)), 1u);
}

TEST(WallPatch, alone_is_asked_wherever_the_point_is) {
  const auto square = scenes::rectangle({-1, -1}, {1, 1});
  const Wall<2> wall(scenes::wall("square", square, 1));
  const int bottom = wall.nearest(at_home, {0, -1}, 1).patch;
  const auto near = wall.nearest_on_patch(at_home, {0.5, 5}, bottom);
  EXPECT_LE((near.point - Vec<2>(0.5, -1)).norm(), 20 * eps);
  EXPECT_EQ(near.patch, bottom);
  EXPECT_EQ(wall.nearest_on_patch(at_home, {7, 5}, bottom).vertex, 1) << "past its end";
}

TEST(WallVertex, is_named_where_a_sharp_corner_is_closest) {
  const Wall<2> wall(scenes::wall("square", scenes::rectangle({-1, -1}, {1, 1}), 1));
  EXPECT_EQ(wall.nearest(at_home, {2, 2}, 9).vertex, 2);
  EXPECT_EQ(wall.nearest(at_home, {2, 0}, 9).vertex, -1);
  EXPECT_LE((wall.vertex(somewhere(), 2) - somewhere() * Vec<2>(1, 1)).norm(), 20 * eps);
  const Wall<2> circle(scenes::wall("circle", scenes::ellipse(1, 1, 64), 1));
  EXPECT_EQ(circle.nearest(at_home, {2, 0}, 9).vertex, -1) << "a smooth surface's vertices are not corners";
}

TEST(WallMayTouch, is_never_false_within_the_margin) {
  for (const bool tank : {false, true}) {
    auto surface = arrow();
    if (tank) surface = scenes::turned_inside_out(surface);
    const Wall<2> wall(scenes::wall("", surface, 1));
    std::mt19937 random(9);
    for (int sample = 0; sample < 1000; ++sample) {
      const Vec<2> x = somewhere() * Vec<2>(4 * scenes::random_vector<Vec<2>>(random, {}));
      const bool near = wall.nearest(somewhere(), x, 100).distance < 0.3;
      EXPECT_TRUE(!near || wall.may_touch(somewhere(), x, 0.3));
    }
  }
}

TEST(WallOfTriangles, knows_the_side_of_a_cube) {
  Surface<3> cube{Eigen::Matrix3Xd(3, 8), Eigen::Matrix3Xi(3, 12)};
  for (int v = 0; v < 8; ++v) cube.vertices.col(v) << (v & 1 ? 1 : -1), (v & 2 ? 1 : -1), (v & 4 ? 1 : -1);
  cube.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,             //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  const Wall<3> wall({"cube", cube, Isometry<3>::Identity(), Twist<3>::Zero(), 1});
  EXPECT_EQ(wall.sharp_vertices().size(), 8u);
  std::mt19937 random(10);
  for (int sample = 0; sample < 2000; ++sample) {
    const Vec<3> x = 2 * scenes::random_vector<Vec<3>>(random, {});
    const Vec<3> beyond = (x.cwiseAbs() - Vec<3>::Ones()).cwiseMax(0);
    const double inside = (Vec<3>::Ones() - x.cwiseAbs()).minCoeff();
    const double exact = inside > 0 ? -inside : beyond.norm();
    EXPECT_NEAR(wall.nearest(Isometry<3>::Identity(), x, 10).distance, exact, 20 * eps) << x.transpose();
  }
}

}  // namespace
}  // namespace splashdown::fluid
