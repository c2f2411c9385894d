#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rigid/shapes/shapes.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::mass_properties_test {

namespace {

using std::numbers::pi;

void expect_same(const MassProperties<2>& a, const MassProperties<2>& b, double relative) {
  const double size = std::sqrt(b.mass);
  EXPECT_NEAR(a.mass, b.mass, relative * b.mass);
  EXPECT_NEAR((a.centre - b.centre).norm(), 0, relative * size);
  EXPECT_NEAR(a.inertia(0, 0), b.inertia(0, 0), relative * b.inertia(0, 0));
}

Surface<2> moved(const Surface<2>& surface, const Isometry<2>& by) {
  return {by.linear() * surface.vertices + by.translation() * Eigen::RowVectorXd::Ones(surface.vertices.cols()),
          surface.facets};
}

/// The unit cube's corner tetrahedron, edges a, b, c along the axes.
Surface<3> corner_tetrahedron(double a, double b, double c) {
  Surface<3> s;
  s.vertices.resize(3, 4);
  s.vertices << 0, a, 0, 0, 0, 0, b, 0, 0, 0, 0, c;
  s.facets.resize(3, 4);
  s.facets << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  return s;
}

}  // namespace

TEST(MassProperties, of_polygons_are_those_of_the_formulas) {
  for (const Shape<2>& shape : {box(0.3, 1.7), wedge(pi / 6, 0.5, 0.2), wedge(0.01, 2, 0), wedge(1.4, 1, 3)})
    expect_same(mass_properties(shape.surface), shape.at_unit_density, 20 * eps);
}

TEST(MassProperties, of_curved_outlines_tend_to_the_formulas_at_second_order) {
  for (const auto& shape_of : {+[](int n) { return circle(0.7, n); }, +[](int n) { return ellipse(2, 0.3, n); },
                               +[](int n) { return capsule(0.5, 1.3, n); }}) {
    const auto error = [&](int n) {
      const Shape<2> s = shape_of(n);
      const MassProperties<2> p = mass_properties(s.surface);
      return Eigen::Vector2d(1 - p.mass / s.at_unit_density.mass,
                             1 - p.inertia(0, 0) / s.at_unit_density.inertia(0, 0));
    };
    const Eigen::Array2d order = (error(64).array() / error(128).array()).log() / std::log(2.);
    EXPECT_NEAR(order(0), 2, 0.01);
    EXPECT_NEAR(order(1), 2, 0.01);
    // Circle of n segments: 1 - sin(2 pi / n) n / (2 pi) = (2 pi / n)^2 / 6; the others have straight or
    // flat parts besides.
    EXPECT_LE(error(256)(0), 4 * pi * pi / 6 / 256 / 256);
    EXPECT_GT(error(256)(0), 0);
  }
}

TEST(MassProperties, of_a_circle_are_the_textbook_ones) {
  const MassProperties<2> p = circle(0.7).at_unit_density;
  EXPECT_NEAR(p.mass, pi * 0.49, 4 * eps);
  EXPECT_NEAR(p.inertia(0, 0), p.mass * 0.49 / 2, 4 * eps);
}

TEST(MassProperties, move_and_turn_with_the_shape) {
  const Shape<2> shape = wedge(0.6, 0.5, 0.2);
  for (const double turn : {0.3, 37 * pi / 180, pi / 2, 2.5}) {
    Isometry<2> by = Isometry<2>::Identity();
    by.translate(Vec<2>(-4, 1e3)).rotate(turn);
    MassProperties<2> expected = shape.at_unit_density;
    expected.centre = by * expected.centre;
    // Coordinates of size 1e3 carry 1e3 eps, a third of a metre of body 3e3 times that.
    expect_same(mass_properties(moved(shape.surface, by)), expected, 1e4 * eps);
  }
}

TEST(MassProperties, do_not_depend_on_how_a_body_is_cut_into_concave_polygons) {
  // An L as one concave outline and as two boxes.
  const std::vector<Vec<2>> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const MassProperties<2> p = polygon(outline).at_unit_density;
  EXPECT_NEAR(p.mass, 4, 20 * eps);
  EXPECT_NEAR(p.centre.x(), (2 * 1 + 2 * 0.5) / 4, 20 * eps);
  EXPECT_NEAR(p.centre.y(), (2 * 0.5 + 2 * 2) / 4, 20 * eps);
  const double lower = 2 * 5. / 12 + 2 * (0.25 * 0.25 + 0.75 * 0.75), upper = lower;
  EXPECT_NEAR(p.inertia(0, 0), lower + upper, 40 * eps);
}

TEST(MassProperties, of_a_tetrahedron_are_the_textbook_ones) {
  const double a = 1, b = 2, c = 3;
  const MassProperties<3> p = mass_properties(corner_tetrahedron(a, b, c));
  const double volume = a * b * c / 6;
  EXPECT_NEAR(p.mass, volume, 10 * eps);
  EXPECT_NEAR((p.centre - Vec<3>(a, b, c) / 4).norm(), 0, 10 * eps);
  // int (x - a/4)^2 = 3/80 V a^2, int (x - a/4)(y - b/4) = -V a b / 80.
  const Eigen::Vector3d e(a, b, c);
  Eigen::Matrix3d s = -volume / 80 * e * e.transpose();
  for (int i = 0; i < 3; ++i) s(i, i) = 3 * volume / 80 * e(i) * e(i);
  EXPECT_NEAR((p.inertia - (s.trace() * Eigen::Matrix3d::Identity() - s)).norm(), 0, 20 * eps);
}

TEST(MassProperties, scale_with_density_and_mass) {
  const MassProperties<2> unit = wedge(0.6, 0.5, 0.2).at_unit_density;
  const MassProperties<2> dense = with_density(unit, 333);
  EXPECT_DOUBLE_EQ(dense.mass, 333 * unit.mass);
  EXPECT_DOUBLE_EQ(dense.inertia(0, 0), 333 * unit.inertia(0, 0));
  const MassProperties<2> heavy = with_mass(dense, 241);
  EXPECT_EQ(heavy.mass, 241);
  EXPECT_DOUBLE_EQ(heavy.inertia(0, 0) / heavy.mass, unit.inertia(0, 0) / unit.mass);
  EXPECT_EQ(heavy.centre, unit.centre);
  EXPECT_THROW(with_density(unit, -1), std::invalid_argument);
  EXPECT_THROW(with_mass(unit, -1), std::invalid_argument);
}

TEST(MassProperties, of_a_surface_inside_out_are_refused) {
  Surface<2> s = box(1, 1).surface;
  s.facets.row(0).swap(s.facets.row(1));
  EXPECT_THROW(mass_properties(s), std::invalid_argument);
}

}  // namespace splashdown::rigid::mass_properties_test
