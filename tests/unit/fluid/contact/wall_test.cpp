#include "fluid/pfem/contact/wall.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/closest_point.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::wall_test {
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
    const Vec<2> a = Vec<2>(s.vertices.col(s.facets(0, f))) - x, b = Vec<2>(s.vertices.col(s.facets(1, f))) - x;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(angle) > std::numbers::pi;
}

double distance_by_all(const Surface<2>& s, const Vec<2>& x) {
  double best = 1e300;
  for (int f = 0; f < s.facets.cols(); ++f)
    best = std::min(
        best,
        (closest_on({Vec<2>(s.vertices.col(s.facets(0, f))), Vec<2>(s.vertices.col(s.facets(1, f)))}, x) - x).norm());
  return best;
}

Surface<2> letter_l() { return outline({{-2, -2}, {2, -2}, {2, -1}, {-1, -1}, {-1, 2}, {-2, 2}}); }
Surface<2> arrow() { return outline({{0, 0}, {2, 2}, {-2, 0}, {2, -2}}); }  // two spikes and a deep notch
Surface<2> blade() { return outline({{-2, 0}, {2, -1e-2}, {2, 1e-2}}); }

struct Sided : testing::TestWithParam<int> {
  static Surface<2> shape(int i) { return std::array{letter_l(), arrow(), blade(), scenes::ellipse(1, 2, 64)}[i]; }
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
  EXPECT_EQ(Wall<2>(scenes::wall("square", scenes::rectangle({0, 0}, {1, 1}), 1)).corners().size(), 4u);
  EXPECT_EQ(Wall<2>(scenes::wall("circle", scenes::ellipse(1, 1, 64), 1)).corners().size(), 0u);
  EXPECT_EQ(Wall<2>(scenes::wall("dodecagon+", scenes::ellipse(1, 1, 13), 1)).corners().size(), 0u);
  EXPECT_EQ(Wall<2>(scenes::wall("hendecagon", scenes::ellipse(1, 1, 11), 1)).corners().size(), 11u);
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
  for (const bool tank : {false, true})
    for (auto surface : {arrow(), scenes::rectangle({-2, -1}, {3, 2}), scenes::ellipse(1, 2, 64)}) {
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

TEST(WallMayTouch, is_false_away_from_the_walls_of_a_convex_tank) {
  const Wall<3> tank(scenes::wall("", scenes::turned_inside_out(scenes::block({-1, -1, -1}, {1, 1, 1})), 1));
  const Isometry<3> pose = Isometry<3>::Identity();
  std::mt19937 random(10);
  for (int sample = 0; sample < 1000; ++sample) {
    const Vec<3> x = 2 * scenes::random_vector<Vec<3>>(random, {});
    EXPECT_EQ(tank.may_touch(pose, x, 0.25), x.lpNorm<Eigen::Infinity>() >= 0.75) << x.transpose();
  }
}

TEST(WallOfTriangles, knows_the_side_of_a_cube) {
  const Wall<3> wall(scenes::wall("cube", scenes::block({-1, -1, -1}, {1, 1, 1}), 1));
  EXPECT_EQ(wall.corners().size(), 8u);
  std::mt19937 random(10);
  for (int sample = 0; sample < 2000; ++sample) {
    const Vec<3> x = 2 * scenes::random_vector<Vec<3>>(random, {});
    const Vec<3> beyond = (x.cwiseAbs() - Vec<3>::Ones()).cwiseMax(0);
    const double inside = (Vec<3>::Ones() - x.cwiseAbs()).minCoeff();
    const double exact = inside > 0 ? -inside : beyond.norm();
    EXPECT_NEAR(wall.nearest(Isometry<3>::Identity(), x, 10).distance, exact, 20 * eps) << x.transpose();
  }
}

TEST(WallOfTriangles, creases_run_between_corners) {
  const Isometry<3> pose = Isometry<3>::Identity();
  const Wall<3> cube(scenes::wall("cube", scenes::block({-1, -1, -1}, {1, 1, 1}), 1));
  EXPECT_TRUE(cube.has_creases());
  const auto on_edge = cube.nearest(pose, {2, 2, 0.3}, 9);
  EXPECT_EQ(on_edge.vertex, -1);
  ASSERT_GE(on_edge.crease, 0);
  EXPECT_EQ(cube.nearest(pose, {2, 2, -0.9}, 9).crease, on_edge.crease);
  EXPECT_NE(cube.nearest(pose, {2, 0.3, 2}, 9).crease, on_edge.crease);
  EXPECT_EQ(cube.nearest(pose, {2, 0.1, 0.3}, 9).crease, -1) << "on a face";
  EXPECT_LE((cube.nearest_on_crease(pose, {3, 0, 0.5}, on_edge.crease) - Vec<3>(1, 1, 0.5)).norm(), 4 * eps);
  EXPECT_LE((cube.nearest_on_crease(pose, {1, 1, 7}, on_edge.crease) - Vec<3>(1, 1, 1)).norm(), 4 * eps) << "its end";

  const auto passed = cube.nearest_crease(pose, {1, 0.8, 0}, {0.6, 1, 0});
  EXPECT_EQ(passed.crease, on_edge.crease);
  EXPECT_LE((passed.point - Vec<3>(1, 1, 0)).norm(), 1e-12);
}

TEST(WallOfTriangles, a_cone_has_a_tip_and_one_ring) {
  const Isometry<3> pose = Isometry<3>::Identity();
  const Wall<3> cone(scenes::wall("cone", scenes::cone(1, 0.5, 64), 1));
  EXPECT_EQ(cone.corners(), std::vector<int>{64});
  const int ring = cone.nearest(pose, {2, 0.01, 0.5}, 9).crease;
  ASSERT_GE(ring, 0);
  for (double angle : {0.3, 1.7, 3.3, 5.9})
    EXPECT_EQ(cone.nearest(pose, {2 * std::cos(angle), 2 * std::sin(angle), 0.5}, 9).crease, ring);
  EXPECT_EQ(cone.nearest(pose, {0.5, 0, 0}, 9).crease, -1);
  EXPECT_EQ(cone.nearest(pose, {0, 0, -1}, 9).vertex, 64);
  EXPECT_EQ(Wall<3>(scenes::wall("flat cone", scenes::cone(1, 0.1, 64), 1)).corners().size(), 0u) << "blunter than 30";
}

// Two slopes that are a ridge for x < 0 and a valley beyond.
TEST(WallOfTriangles, a_crease_ends_where_a_ridge_becomes_a_valley) {
  Surface<3> s{Eigen::Matrix3Xd(3, 9), Eigen::Matrix3Xi(3, 8)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s.vertices.col(3 * j + i) << i - 1, j - 1, j == 1 ? 0 : 0.35 * (i - 1);
  s.facets << 3, 0, 4, 4, 3, 4, 4, 4,  //
      0, 1, 2, 1, 4, 7, 5, 8,          //
      4, 4, 5, 2, 6, 6, 8, 7;
  const Wall<3> wall(scenes::wall("slopes", s, 1));
  const auto ridge = wall.nearest(Isometry<3>::Identity(), {-0.5, 0, 0.1}, 1).crease,
             valley = wall.nearest(Isometry<3>::Identity(), {0.5, 0, 0}, 1).crease;
  ASSERT_GE(ridge, 0);
  ASSERT_GE(valley, 0);
  EXPECT_TRUE(wall.is_convex({0, -1, -1, ridge}));
  EXPECT_FALSE(wall.is_convex({0, -1, -1, valley}));
  EXPECT_TRUE(wall.is_convex({0, -1, 4, -1})) << "water flows around the end of the ridge";
}

TEST(WallConvex, corners_of_a_star_are_but_not_the_creases_between_its_tips) {
  constexpr int tips = 5;
  const Wall<3> wall(scenes::wall("star", scenes::star(tips, 1, 0.5, 1), 1));
  EXPECT_EQ(wall.corners().size(), 4u * tips);
  for (int v : wall.corners()) EXPECT_TRUE(wall.is_convex({0, -1, v, -1})) << v;
  for (int i = 0; i < 2 * tips; ++i) {
    const double angle = std::numbers::pi * i / tips, r = i % 2 ? 0.5 : 1;
    const int crease = wall.nearest(Isometry<3>::Identity(), {r * std::cos(angle), r * std::sin(angle), 0}, 1).crease;
    ASSERT_GE(crease, 0) << i;
    EXPECT_EQ(wall.is_convex({0, -1, -1, crease}), i % 2 == 0) << i;
  }
  const Wall<3> around(scenes::wall("tank", scenes::turned_inside_out(scenes::block({-1, -1, -1}, {1, 1, 1})), 1));
  for (int v : around.corners()) EXPECT_FALSE(around.is_convex({0, -1, v, -1})) << v;
}

TEST(WallConvex, solids_in_one_piece_that_nothing_stands_out_of) {
  const auto is_convex = [](Surface<3> s) { return Wall<3>(scenes::wall("", std::move(s), 1)).is_convex(); };
  const auto cube = scenes::block({-1, -1, -1}, {1, 1, 1});
  EXPECT_TRUE(is_convex(cube));
  EXPECT_TRUE(is_convex(scenes::cone(1, 0.3, 40)));
  EXPECT_FALSE(is_convex(scenes::turned_inside_out(cube))) << "a tank";
  EXPECT_FALSE(is_convex(scenes::together(cube, scenes::block({2, -1, -1}, {4, 1, 1})))) << "two pieces";
  auto dented = scenes::cone(1, 0.3, 40);
  for (int v = 0; v < dented.vertices.cols(); ++v) dented.vertices.col(v).z() *= 1 + 1e-3 * (v % 2);
  EXPECT_FALSE(is_convex(dented));
}

TEST(WallCentre, is_that_of_the_volume_and_as_deep_as_the_nearest_facet) {
  const Wall<3> cube(scenes::wall("", scenes::block({1, 2, 3}, {3, 8, 9}), 1));
  EXPECT_LE((cube.centre() - Vec<3>(2, 5, 6)).norm(), 100 * eps);
  EXPECT_NEAR(cube.depth_of_centre(), 1, 100 * eps);
  const auto left = scenes::block({-3, -1, -1}, {-1, 1, 1}), right = scenes::block({1, -1, -1}, {3, 1, 1});
  const Wall<3> two(scenes::wall("", scenes::together(left, right), 1));
  EXPECT_NEAR(two.depth_of_centre(), -1, 100 * eps) << "in the middle between two";
  const Wall<2> triangle(scenes::wall("", outline({{0, 0}, {3, 0}, {0, 3}}), 1));
  EXPECT_LE((triangle.centre() - Vec<2>(1, 1)).norm(), 100 * eps);
}

template <int d>
Wall<d> mirrored(const Surface<d>& surface, const std::optional<Mirror>& mirror) {
  WallSpec<d> spec;
  spec.surface = surface;
  spec.mirror = mirror;
  return Wall<d>(spec);
}

// A plane of symmetry ends the patches of hulls that reach across it, and makes no edge that water flows around.
TEST(WallInMirror, the_line_of_a_smooth_hull_in_the_plane_is_a_crease_that_water_does_not_pass) {
  const auto cone = scenes::cone(1, 0.3, 32);
  const auto wall = mirrored<3>(cone, Mirror{1, 0}), whole = mirrored<3>(cone, {});
  const Isometry<3> pose = Isometry<3>::Identity();
  const auto below = wall.nearest_in_mirror(pose, Vec<3>(0.4, 0, -0.1));
  ASSERT_GE(below.crease, 0);
  EXPECT_EQ(below.point.y(), 0) << "to the bit";
  EXPECT_TRUE(wall.is_in_mirror(-1, below.crease));
  EXPECT_FALSE(wall.is_convex({0, -1, -1, below.crease}));
  EXPECT_EQ(whole.nearest_in_mirror(pose, Vec<3>(0.4, 0, -0.1)).crease, -1);
  // On either side it looks the same, and as it does without the plane.
  for (const Vec<3>& x : {Vec<3>(0.3, 0.2, -0.1), Vec<3>(-0.5, 0.01, 0.1), Vec<3>(0.1, 0.6, 0.2)}) {
    const auto near = wall.nearest(pose, x, 2), image = wall.nearest(pose, Mirror{1, 0}.image<3>(x), 2);
    EXPECT_NEAR(near.distance, whole.nearest(pose, x, 2).distance, eps);
    EXPECT_NEAR(near.distance, image.distance, eps);
    EXPECT_NE(near.patch, image.patch);
  }
}

TEST(WallInMirror, in_the_plane_the_water_stands_where_a_hull_meets_the_mirror) {
  const auto circle = mirrored<2>(scenes::ellipse(1, 1, 64), Mirror{0, 0});
  ASSERT_EQ(circle.corners().size(), 2u) << "nothing else ends its patches";
  for (int v : circle.corners()) {
    EXPECT_TRUE(circle.is_smooth(v));
    EXPECT_FALSE(circle.is_convex({0, -1, v}));
    EXPECT_EQ(circle.vertex(at_home, v).x(), 0);
  }
}

TEST(WallInMirror, the_side_of_a_tank_there_is_no_solid) {
  const auto box = scenes::turned_inside_out<2>(scenes::rectangle({0, -1}, {3, 1}));
  const auto tank = mirrored<2>(box, Mirror{0, 0});
  const Vec<2> x(0.1, 0.2);
  EXPECT_NEAR(tank.distance_unsigned(at_home, x, 5), 0.1, eps);
  EXPECT_NEAR(tank.distance_of_solid(at_home, x, 5), 0.8, eps);
  EXPECT_TRUE(tank.is_mirror(tank.nearest(at_home, x, 5).patch));
  EXPECT_FALSE(tank.is_mirror(tank.nearest(at_home, Vec<2>(1, 0.9), 5).patch));
}

}  // namespace
}  // namespace splashdown::fluid::wall_test
