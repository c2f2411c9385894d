#include "rigid/hydrostatics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rigid/shapes.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid {

namespace {

using std::numbers::pi;

const double rho = 1000;

Isometry<2> at(double x, double y, double turn = 0) {
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translate(Vec<2>(x, y)).rotate(turn);
  return pose;
}

/// Unit-sided in shape, then scaled; outward normals.
Surface<3> brick(double length, double width, double height) {
  Surface<3> s;
  s.vertices.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    s.vertices.col(i) << ((i & 1) - 0.5) * length, (((i >> 1) & 1) - 0.5) * width, ((i >> 2) - 0.5) * height;
  s.facets.resize(3, 12);
  s.facets << 0, 0, 4, 4, 0, 0, 1, 1, 3, 3, 2, 2,  //
      2, 3, 5, 7, 1, 5, 3, 7, 2, 6, 0, 4,          //
      3, 1, 7, 6, 5, 4, 7, 5, 6, 7, 4, 6;
  return s;
}

}  // namespace

TEST(Box, floats_at_its_density_ratio_with_the_textbook_metacentre) {
  const double b = 1.2, h = 0.5;
  const Surface<2> s = box(b, h).surface;
  for (const double ratio : {1e-3, 0.1, 1. / 3, 0.5, 0.9, 0.999}) {
    const auto f = floating(s, at(3, 7), ratio * rho * b * h, rho, 2.);
    ASSERT_TRUE(f);
    const double draft = ratio * h;
    EXPECT_NEAR(f->draft, draft, 10 * eps);
    EXPECT_NEAR(f->submerged.volume, ratio * b * h, 10 * eps);
    EXPECT_NEAR(f->submerged.waterline, b, 10 * eps);
    EXPECT_NEAR((f->submerged.centre - Vec<2>(3, 2 - draft / 2)).norm(), 0, 1e-12);
    EXPECT_NEAR(f->pose.translation().x(), 3, 0);
    // GM = T/2 + B^2 / (12 T) - H/2
    const double gm = draft / 2 + b * b / (12 * draft) - h / 2;
    EXPECT_NEAR(f->metacentric_height, gm, 1e-12 * std::max(1., gm));
  }
}

TEST(Submerged, of_a_dry_and_of_a_drowned_body_is_nothing_and_all) {
  const Shape<2> shape = wedge(0.5, 1, 0.3);
  const Submerged<2> dry = submerged(shape.surface, at(0, 0.1), 0.),
                     wet = submerged(shape.surface, at(1, -5), 0.);
  EXPECT_EQ(dry.volume, 0);
  EXPECT_EQ(dry.waterline, 0);
  EXPECT_NEAR(wet.volume, shape.at_unit_density.mass, 10 * eps);
  EXPECT_NEAR(wet.waterline, 0, 4 * eps);
  EXPECT_NEAR((wet.centre - (shape.at_unit_density.centre + Vec<2>(1, -5))).norm(), 0, 100 * eps);
}

TEST(Submerged, circle_to_its_middle_is_a_half_disc) {
  const Submerged<2> s = submerged(circle(1, 4096).surface, at(0, 0), 0.);
  const double polygon_error = 4 * pi * pi / 6 / 4096 / 4096;
  EXPECT_NEAR(s.volume, pi / 2, pi / 2 * polygon_error * 1.01);
  EXPECT_NEAR(s.centre.y(), -4 / (3 * pi), polygon_error);
  EXPECT_NEAR(s.waterline, 2, 4 * eps);
  EXPECT_NEAR(s.waterline_moment(0, 0), 8. / 12, 10 * eps);
}

TEST(Submerged, catamaran_has_the_waterline_of_both_hulls) {
  // A concave outline: two legs of breadth 1, their inner sides 2 apart, under a deck.
  const std::vector<Vec<2>> outline{{-2, 0}, {-1, 0}, {-1, 1}, {1, 1}, {1, 0}, {2, 0}, {2, 2}, {-2, 2}};
  const Submerged<2> s = submerged(polygon(outline).surface, at(0, 0), 0.5);
  EXPECT_NEAR(s.volume, 1, 10 * eps);
  EXPECT_NEAR(s.waterline, 2, 10 * eps);
  EXPECT_NEAR(s.waterline_moment(0, 0), 2 * (1. / 12 + 1.5 * 1.5), 20 * eps);
}

TEST(Submerged, brick_has_the_moments_of_its_water_plane) {
  Isometry<3> pose = Isometry<3>::Identity();
  pose.translation() << 5, -3, 0.1;
  const Submerged<3> s = submerged(brick(2, 1, 0.6), pose, 0.);
  EXPECT_NEAR(s.volume, 2 * 0.2, 20 * eps);
  EXPECT_NEAR((s.centre - Vec<3>(5, -3, -0.1)).norm(), 0, 50 * eps);
  EXPECT_NEAR(s.waterline, 2, 20 * eps);
  EXPECT_NEAR((s.waterline_moment - Eigen::Matrix2d(Eigen::Vector2d(8. / 12, 2. / 12).asDiagonal())).norm(),
              0, 50 * eps);
  const auto f = floating(brick(2, 1, 0.6), pose, 400., rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->draft, 0.2, 50 * eps);
  EXPECT_NEAR(f->metacentric_height, 0.1 + 1. / (12 * 0.2) - 0.3, 1e-13);
}

TEST(Submerged, changes_with_height_at_the_rate_of_the_waterline) {
  const Surface<2> s = ellipse(1, 0.4).surface;
  const double step = 1e-4;
  for (const double turn : {0., 0.4, 1.3}) {
    const double up = submerged(s, at(0, step, turn), 0.1).volume,
                 down = submerged(s, at(0, -step, turn), 0.1).volume;
    EXPECT_NEAR((down - up) / (2 * step), submerged(s, at(0, 0, turn), 0.1).waterline, 1e-4);
  }
}

TEST(Floating, body_heavier_than_water_sinks) {
  const Surface<2> s = box(1, 1).surface;
  EXPECT_FALSE(floating(s, at(0, 0), 1001., rho, 0.));
  EXPECT_FALSE(floating_stable(s, at(0, 0), 1001., rho, 0.));
  EXPECT_THROW(floating(s, at(0, 0), 0., rho, 0.), std::invalid_argument);
}

TEST(Floating, wedge_has_the_draft_of_a_triangle) {
  const double deadrise = pi / 6, mass = 20;
  const Shape<2> shape = wedge(deadrise, 0.5, 0.1);
  const auto f = floating(centred(shape.surface, shape.at_unit_density.centre), at(0, 0), mass, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->draft, std::sqrt(mass / rho * std::tan(deadrise)), 10 * eps);
}

TEST(FloatingStable, wide_box_returns_upright_from_any_heel) {
  const Surface<2> s = box(1, 0.3).surface;
  for (const double heel : {-0.6, -0.1, 0., 0.2, 1.2}) {
    const auto f = floating_stable(s, at(0, 0, heel), 0.5 * rho * 0.3, rho, 0.);
    ASSERT_TRUE(f);
    EXPECT_NEAR(angle(f->pose), 0, 1e-12);
    EXPECT_NEAR(f->draft, 0.15, 1e-12);
  }
}

TEST(FloatingStable, square_of_half_density_floats_on_its_edge) {
  const auto f = floating_stable(box(1, 1).surface, at(0, 0), 500., rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(angle(f->pose), pi / 4, 1e-12);
  EXPECT_GT(f->metacentric_height, 0);
}

TEST(FloatingStable, square_of_a_quarter_density_heels_by_the_known_angle) {
  const auto f = floating_stable(box(1, 1).surface, at(0, 0), 250., rho, 0.);
  ASSERT_TRUE(f);
  const double heel = angle(f->pose);
  EXPECT_GT(heel, 0.01);
  EXPECT_LT(heel, pi / 4 - 0.01);
  EXPECT_GT(f->metacentric_height, 0);
  EXPECT_NEAR(f->submerged.centre.x(), 0, 1e-12);
  // While both bottom corners are wet and both top corners dry (0.2113 < s < 0.25), the wall-sided formula
  // is exact: BM (1 + tan^2 / 2) = BG with BM = 1 / (12 s) and BG = (1 - s) / 2.
  const double ratio = 0.25, tan2 = 2 * (6 * ratio * (1 - ratio) - 1);
  EXPECT_NEAR(std::tan(heel) * std::tan(heel), tan2, 1e-11);
}

TEST(FloatingStable, capsule_rolled_by_ten_degrees_comes_back) {
  const Shape<2> shape = capsule(0.5, 2);
  const double mass = shape.at_unit_density.mass * rho / 3;
  const auto f = floating_stable(shape.surface, at(0, 1, 10 * pi / 180), mass, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(angle(f->pose), 0, 1e-11);
}

TEST(FloatingStable, circle_stays_as_it_is) {
  const Shape<2> shape = circle(0.5);
  const auto f =
      floating_stable(shape.surface, at(0, 0, 0.1), 0.3 * rho * shape.at_unit_density.mass, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->metacentric_height, 0, 1e-3);
  EXPECT_NEAR(angle(f->pose), 0.1, 2 * pi / default_segments);
}

}  // namespace splashdown::rigid
