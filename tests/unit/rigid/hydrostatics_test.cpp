#include "rigid/shapes/hydrostatics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rigid/shapes/solids.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::hydrostatics_test {

namespace {

using std::numbers::pi;

const double rho = 1000;

Isometry<2> at(double x, double y, double turn = 0) {
  Isometry<2> pose = Isometry<2>::Identity();
  pose.translate(Vec<2>(x, y)).rotate(turn);
  return pose;
}

Surface<3> brick(double length, double width, double height) { return box({length, width, height}).surface; }

Isometry<3> posed(double heading, double pitch, double roll) {
  Isometry<3> pose = Isometry<3>::Identity();
  pose.linear() = (Eigen::AngleAxisd(heading, Vec<3>::UnitZ()) * Eigen::AngleAxisd(-pitch, Vec<3>::UnitY()) *
                   Eigen::AngleAxisd(roll, Vec<3>::UnitX()))
                      .toRotationMatrix();
  return pose;
}

Vec<3> nose(const Floating<3>& f) { return f.pose.linear().col(0); }
Vec<3> mast(const Floating<3>& f) { return f.pose.linear().col(2); }

std::vector<double> heels(double step, double last) {
  std::vector<double> list;
  for (double heel = 0; heel < last + 0.5 * step; heel += step) list.push_back(heel);
  return list;
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
  const Submerged<2> dry = submerged(shape.surface, at(0, 0.1), 0.), wet = submerged(shape.surface, at(1, -5), 0.);
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
  EXPECT_NEAR((s.waterline_moment - Eigen::Matrix2d(Eigen::Vector2d(8. / 12, 2. / 12).asDiagonal())).norm(), 0,
              50 * eps);
  const auto f = floating(brick(2, 1, 0.6), pose, 400., rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->draft, 0.2, 50 * eps);
  EXPECT_NEAR(f->metacentric_height, 0.1 + 1. / (12 * 0.2) - 0.3, 1e-13);
}

TEST(Submerged, changes_with_height_at_the_rate_of_the_waterline) {
  const Surface<2> s = ellipse(1, 0.4).surface;
  const double step = 1e-4;
  for (const double turn : {0., 0.4, 1.3}) {
    const double up = submerged(s, at(0, step, turn), 0.1).volume, down = submerged(s, at(0, -step, turn), 0.1).volume;
    EXPECT_NEAR((down - up) / (2 * step), submerged(s, at(0, 0, turn), 0.1).waterline, 1e-4);
  }
}

TEST(Floating, body_heavier_than_water_sinks) {
  const Surface<2> s = box(1, 1).surface;
  EXPECT_FALSE(floating(s, at(0, 0), 1001., rho, 0.));
  EXPECT_FALSE(floating_stable<2>(s, at(0, 0), 1001., rho, 0.));
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
    const auto f = floating_stable<2>(s, at(0, 0, heel), 0.5 * rho * 0.3, rho, 0.);
    ASSERT_TRUE(f);
    EXPECT_NEAR(angle(f->pose), 0, 1e-12);
    EXPECT_NEAR(f->draft, 0.15, 1e-12);
  }
}

TEST(FloatingStable, square_of_half_density_floats_on_its_edge) {
  const auto f = floating_stable<2>(box(1, 1).surface, at(0, 0), 500., rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(angle(f->pose), pi / 4, 1e-12);
  EXPECT_GT(f->metacentric_height, 0);
}

TEST(FloatingStable, square_of_a_quarter_density_heels_by_the_known_angle) {
  const auto f = floating_stable<2>(box(1, 1).surface, at(0, 0), 250., rho, 0.);
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
  const auto f = floating_stable<2>(shape.surface, at(0, 1, 10 * pi / 180), mass, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(angle(f->pose), 0, 1e-11);
}

TEST(FloatingStable, circle_stays_as_it_is) {
  const Shape<2> shape = circle(0.5);
  const auto f = floating_stable<2>(shape.surface, at(0, 0, 0.1), 0.3 * rho * shape.at_unit_density.mass, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(f->metacentric_height, 0, 1e-3);
  EXPECT_NEAR(angle(f->pose), 0.1, 2 * pi / default_segments);
}

TEST(SpatialFloating, box_has_the_metacentres_of_the_textbook) {
  const double l = 2, b = 1, h = 0.6, ratio = 0.4, draft = ratio * h;
  const auto f = floating(brick(l, b, h), Isometry<3>::Identity(), ratio * rho * l * b * h, rho, 0.);
  ASSERT_TRUE(f);
  const double kb = draft / 2, kg = h / 2;
  EXPECT_NEAR(metacentric_height<3>(*f, {0, 1}), kb + b * b / (12 * draft) - kg, 1e-13) << "roll: sides rise";
  EXPECT_NEAR(metacentric_height<3>(*f, {1, 0}), kb + l * l / (12 * draft) - kg, 1e-13) << "pitch: ends rise";
}

TEST(SpatialFloating, cone_floats_on_its_apex_with_its_textbook_draft) {
  const double deadrise = pi / 4, ratio = 0.5;  // of a cone of height 1
  const auto shape = cone(deadrise, 1);
  const auto f = floating(centred<3>(shape.surface, shape.at_unit_density.centre), Isometry<3>::Identity(),
                          ratio * rho * shape.at_unit_density.mass, rho, 0.);
  ASSERT_TRUE(f);
  // V ~ T^3. The polyhedron encloses (2 pi / n)^2 / 6 less with n = 91 edges around at the least: T grows by a third.
  const double draft = std::cbrt(ratio), missing = std::pow(2 * pi / 91, 2) / 6;
  EXPECT_NEAR(f->draft, draft, missing / 3 * draft);
  // KB = 3/4 T, BM = (pi r^4 / 4) / (pi r^2 T / 3) = 3/4 r^2 / T with r = T, KG = 3/4.
  EXPECT_NEAR(metacentric_height<3>(*f, {0, 1}), 1.5 * draft - 0.75, 3 * missing);
}

TEST(SpatialFloatingStable, sphere_turns_its_heavy_side_down) {
  const double radius = 0.5, low = 0.1;  // the centre of mass below the sphere's
  const Vec<3> centre = low * Vec<3>(1, 2, -2) / 3;
  const auto shape = sphere(radius);
  const auto f = floating_stable<3>(centred<3>(shape.surface, centre), posed(0.3, 0.5, -0.2),
                                    0.3 * rho * shape.at_unit_density.mass, rho, 0.);
  ASSERT_TRUE(f);
  // Of a sphere GM is the distance of both centres; facets of 360 deg / 128 spoil it by (2 pi / 128)^2 / 8 radii.
  const double facets = std::pow(2 * pi / 128, 2) / 8 * radius;
  EXPECT_NEAR(f->metacentric_height, low, 3 * facets);
  EXPECT_NEAR((f->pose.linear() * centre / low + Vec<3>::UnitZ()).norm(), 0, 3 * facets / low);
}

TEST(SpatialFloatingStable, capsule_lies_flat) {
  const double r = 0.3, straight = 1, ratio = 0.5;
  const auto shape = capsule_of_revolution(r, straight);
  const auto f =
      floating_stable<3>(shape.surface, posed(0.4, 0.7, 0.2), ratio * rho * shape.at_unit_density.mass, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(nose(*f).z(), 0, 1e-9) << "the nose is level";
  EXPECT_NEAR(f->draft, r, 1e-3 * r) << "half of it is wet";
  // Pitch: the water plane is a rectangle between two half discs; half the volume, and its centre, are below it.
  const double moment =
      2 * r * std::pow(straight, 3) / 12 +
      2 * (pi * std::pow(r, 4) / 8 + pi * r * r / 2 * straight * straight / 4 + 2 * r * r * r / 3 * straight);
  const double volume = pi * r * r * straight / 2 + 2. / 3 * pi * r * r * r;
  const double depth = (2. / 3 * r * r * r * straight + pi * std::pow(r, 4) / 4) / volume;
  const Slope<3> along = nose(*f).head<2>().normalized();
  EXPECT_NEAR(metacentric_height<3>(*f, along), moment / volume - depth, 2e-3 * moment / volume);
  EXPECT_NEAR(metacentric_height<3>(*f, {-along.y(), along.x()}), 0, 1e-3 * r) << "a round body rolls freely";
}

TEST(SpatialFloatingStable, log_of_half_density_floats_on_its_edge) {
  const auto f = floating_stable<3>(brick(4, 1, 1), Isometry<3>::Identity(), 0.5 * 4 * rho, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_NEAR(std::abs(mast(*f).z()), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(nose(*f).z(), 0, 1e-9);
  EXPECT_GT(f->metacentric_height, 0);
}

// On its edge GM vanishes in roll, but the energy falls beside it.
TEST(SpatialFloatingStable, cube_of_half_density_does_not_stay_on_its_edge) {
  Isometry<3> on_edge = Isometry<3>::Identity();
  on_edge.linear() = Eigen::AngleAxisd(0.25 * pi, Vec<3>::UnitY()).toRotationMatrix();
  const auto f = floating_stable<3>(brick(1, 1, 1), on_edge, 0.5 * rho, rho, 0.);
  ASSERT_TRUE(f);
  EXPECT_GT(f->metacentric_height, 0.01);
}

TEST(SpatialFloatingStable, box_comes_back_from_any_attitude_within_reach) {
  const Surface<3> s = brick(2, 1, 0.3);
  for (const double heel : {-0.7, 0.2, 1.2}) {
    const auto f = floating_stable<3>(s, posed(37 * pi / 180, 0.4, heel), 0.5 * rho * 0.6, rho, 1.);
    ASSERT_TRUE(f);
    EXPECT_NEAR(mast(*f).z(), 1, 1e-12);
    EXPECT_NEAR(f->draft, 0.15, 1e-9);
  }
}

// Nothing of a body's stability depends on where it heads.
TEST(SpatialFloatingStable, turns_with_the_heading) {
  const auto shape = revolved(std::vector<Vec<2>>{{0, 0}, {0.4, 0.3}, {0.2, 1.4}});
  const Surface<3> s = centred<3>(shape.surface, shape.at_unit_density.centre);
  const double mass = rho / 3 * shape.at_unit_density.mass;
  const auto a = floating_stable<3>(s, posed(0, 0.2, 0.5), mass, rho, 0.),
             b = floating_stable<3>(s, posed(37 * pi / 180, 0.2, 0.5), mass, rho, 0.);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->draft, b->draft, 1e-9);
  EXPECT_NEAR(a->metacentric_height, b->metacentric_height, 1e-9);
  EXPECT_NEAR(mast(*a).z(), mast(*b).z(), 1e-9);
}

TEST(RightingLevers, of_a_wall_sided_body_are_those_of_the_formula) {
  const double l = 2, b = 1, h = 0.6, draft = 0.3, mass = rho * l * b * draft;
  const auto rest = floating(brick(l, b, h), Isometry<3>::Identity(), mass, rho, 0.);
  ASSERT_TRUE(rest);
  const double bm = b * b / (12 * draft), gm = draft / 2 + bm - h / 2;
  const double limit = std::atan(2 * std::min(draft, h - draft) / b);  // then deck or bilge come to the water
  for (const auto& f : righting_levers(brick(l, b, h), *rest, mass, rho, 0., {1, 0}, heels(0.05, limit - 0.05)))
    EXPECT_NEAR(f.lever, std::sin(f.heel) * (gm + 0.5 * bm * std::pow(std::tan(f.heel), 2)), 1e-9) << f.heel;
}

// GZ is the slope of the energy over the weight, whatever the hull does in trim. Simpson's rule with steps of 2 deg:
// the kinks of the curve, where edges come to the water, cost a share of the step squared times the jump of its slope.
TEST(RightingLevers, integrate_to_the_height_that_the_centres_part_by) {
  const auto shape = cone(pi / 3, 0.5);  // ends that differ, on its side: it trims as it heels
  const Vec<3> centre = shape.at_unit_density.centre + Vec<3>(0.02, 0.05, 0);
  const Surface<3> s = centred<3>(shape.surface, centre);
  const double mass = 0.4 * rho * shape.at_unit_density.mass;
  const auto rest = floating_stable<3>(s, posed(0, 0.1, 0.1), mass, rho, 0.);
  ASSERT_TRUE(rest);
  const double step = 2 * pi / 180;
  const auto curve = righting_levers(s, *rest, mass, rho, 0., {1, 0}, heels(step, 60 * pi / 180));
  const auto height = [](const Floating<3>& f) { return f.pose.translation().z() - f.submerged.centre.z(); };
  double area = 0, largest = 0;
  for (std::size_t i = 0; i + 2 < curve.size(); i += 2) {
    area += step / 3 * (curve[i].lever + 4 * curve[i + 1].lever + curve[i + 2].lever);
    largest = std::max(largest, std::abs(curve[i].lever));
  }
  EXPECT_NEAR(curve.front().lever, 0, 1e-9);
  EXPECT_NEAR(area, height(curve.back().floating) - height(curve.front().floating), step * step * largest);
  for (const auto& f : curve) EXPECT_NEAR(f.floating.submerged.centre.x(), f.floating.pose.translation().x(), 1e-8);
}

}  // namespace splashdown::rigid::hydrostatics_test
