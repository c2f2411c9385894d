#include "rigid/shapes/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::shapes_test {

namespace {

using std::numbers::pi;
using Points = std::vector<Vec<2>>;

std::string polygon_failure(const Points& points) {
  return failure([&] { polygon(points); });
}

Points vertices(const Shape<2>& shape) {
  Points points;
  for (const auto& x : shape.surface.vertices.colwise()) points.emplace_back(x);
  return points;
}

}  // namespace

TEST(Outlines, are_closed_and_counter_clockwise) {
  for (const Shape<2>& shape :
       {box(1, 2), wedge(0.5, 1, 0.3), wedge(0.5, 1, 0), circle(1), ellipse(2, 1, 33), capsule(0.5, 2)}) {
    const Surface<2>& s = shape.surface;
    ASSERT_EQ(s.facets.cols(), s.vertices.cols());
    for (Eigen::Index f = 0; f < s.facets.cols(); ++f)
      EXPECT_EQ(s.facets(1, f), s.facets(0, (f + 1) % s.facets.cols()));
    EXPECT_GT(mass_properties(s).mass, 0);
  }
}

TEST(Outlines, of_every_shape_are_valid_polygons) {
  for (const Shape<2>& shape :
       {box(1, 1e-3), wedge(0.01, 1, 0.3), wedge(0.5, 1, 0), circle(1), ellipse(5, 0.1), capsule(0.5, 2)}) {
    EXPECT_EQ(polygon_failure(vertices(shape)), "");
  }
}

TEST(Outlines, of_curves_have_their_vertices_on_the_curve) {
  EXPECT_EQ(circle(0.7).surface.vertices.cols(), default_segments);
  for (const Vec<2>& x : vertices(circle(0.7, 100))) EXPECT_NEAR(x.norm(), 0.7, 2 * eps);
  for (const Vec<2>& x : vertices(ellipse(3, 0.5, 100)))
    EXPECT_NEAR(x.cwiseQuotient(Vec<2>(3, 0.5)).norm(), 1, 4 * eps);
  for (const Vec<2>& x : vertices(capsule(0.5, 2, 100)))
    EXPECT_NEAR((x - Vec<2>(std::copysign(1., x.x()), 0)).norm(), 0.5, 4 * eps);
}

TEST(Wedge, stands_on_its_keel) {
  const Shape<2> shape = wedge(pi / 6, 0.5, 0.2);
  const double chine = 0.25 * std::tan(pi / 6);
  EXPECT_EQ(shape.surface.vertices.col(0), Vec<2>(0, 0));
  EXPECT_EQ(shape.surface.vertices.row(1).minCoeff(), 0);
  EXPECT_NEAR(shape.surface.vertices(1, 1), chine, eps);
  EXPECT_NEAR(shape.surface.vertices.row(1).maxCoeff(), chine + 0.2, eps);
  EXPECT_EQ(shape.surface.vertices.cols(), 5);
  EXPECT_EQ(wedge(pi / 6, 0.5, 0).surface.vertices.cols(), 3);
}

TEST(Centred, surface_has_its_centre_of_mass_at_the_origin) {
  const Shape<2> shape = wedge(pi / 6, 0.5, 0.2);
  const Surface<2> body = centred(shape.surface, shape.at_unit_density.centre);
  EXPECT_NEAR(mass_properties(body).centre.norm(), 0, 4 * eps);
}

TEST(Polygon, given_clockwise_is_turned) {
  const Points clockwise{{0, 0}, {0, 1}, {2, 1}, {2, 0}};
  const Shape<2> shape = polygon(clockwise);
  EXPECT_NEAR(mass_properties(shape.surface).mass, 2, 10 * eps);
  EXPECT_EQ(shape.surface.vertices.col(0), clockwise[0]);
  EXPECT_EQ(shape.surface.vertices.col(1), clockwise[3]);
}

TEST(Polygon, may_be_concave_and_have_points_on_straight_edges) {
  EXPECT_EQ(polygon_failure({{0, 0}, {2, 0}, {2, 1}, {1, 0.2}, {0, 1}}), "");
  EXPECT_EQ(polygon_failure({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}), "");
  EXPECT_EQ(polygon_failure({{0, 0}, {1, 0}, {0, 1}}), "");
}

TEST(Polygon, that_is_none_is_refused_with_rule_and_value) {
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {1, 0}}), "2 points; an outline needs at least 3"));
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "points 1 and 4 are the same, (0, 0)"));
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {1, 0}, {2, 0}}), "area of 0 m^2"));
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {2, 1}, {2, 0}, {0, 3}}), "edges 1 (0, 0)-(2, 1) and 3 (2, 0)-(0, 3)"));
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}), "touch or cross"));
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {2, 0}, {2, 2}, {2, 1}, {0, 1}}), "folds back onto itself at point 3"));
  EXPECT_TRUE(says(polygon_failure({{0, 0}, {1, 0}, {1, std::nan("")}}), "point 3"));
}

TEST(Shapes, with_impossible_measures_are_refused_with_rule_and_value) {
  EXPECT_EQ(failure([] { circle(-1); }), "circle: radius is -1; it must be positive");
  EXPECT_EQ(failure([] { box(1, 0); }), "box: height is 0; it must be positive");
  EXPECT_EQ(failure([] { ellipse(1, std::nan("")); }), "ellipse: semi-axis b is nan; it must be positive");
  EXPECT_EQ(failure([] { capsule(1, 0); }), "capsule: straight length is 0; it must be positive");
  EXPECT_EQ(failure([] { capsule(1, 1, 31); }), "capsule: 31 segments; the number must be even");
  EXPECT_EQ(failure([] { circle(1, 3); }), "ellipse: 3 segments; at least 8");
  EXPECT_TRUE(says(failure([] { wedge(0, 1, 1); }), "deadrise is 0 degrees"));
  EXPECT_TRUE(says(failure([] { wedge(2, 1, 1); }), "between 0 and 90"));
  EXPECT_EQ(failure([] { wedge(0.5, 1, -1); }), "wedge: side height is -1; it must not be negative");
}

}  // namespace splashdown::rigid::shapes_test
