#include "rigid/shapes/spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace splashdown::rigid::spline_test {
namespace {

using Points = std::vector<Vec<2>>;
using std::numbers::pi;

Points on_circle(int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back({std::cos(2 * pi * i / n), std::sin(2 * pi * i / n)});
  return points;
}

/// Basis of de Boor's recursion, which the library does not use: N_i,p(u).
double basis(const std::vector<double>& knots, std::size_t i, std::size_t p, double u) {
  if (p == 0) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
  const double left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
  return (left > 0 ? (u - knots[i]) / left * basis(knots, i, p - 1, u) : 0) +
         (right > 0 ? (knots[i + p + 1] - u) / right * basis(knots, i + 1, p - 1, u) : 0);
}

Vec<2> on_clamped(const Points& points, std::size_t degree, double share) {
  const auto spans = points.size() - degree;
  std::vector<double> knots;
  for (std::size_t i = 0; i < points.size() + degree + 1; ++i)
    knots.push_back(std::clamp(static_cast<double>(i) - static_cast<double>(degree), 0., static_cast<double>(spans)));
  const double u = share * static_cast<double>(spans) * (1 - 1e-12);
  Vec<2> x = Vec<2>::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) x += basis(knots, i, degree, u) * points[i];
  return x;
}

double distance_to(const Points& line, const Vec<2>& x) {
  double least = INFINITY;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec<2> edge = line[i] - line[i - 1];
    const double along = std::clamp((x - line[i - 1]).dot(edge) / edge.squaredNorm(), 0., 1.);
    least = std::min(least, (x - line[i - 1] - along * edge).norm());
  }
  return least;
}

TEST(Spline, of_degree_one_is_its_polygon) {
  const Points triangle{{0, 0}, {2, 0}, {0, 1}};
  EXPECT_EQ(sampled({triangle, 1}).size(), 3U);
  EXPECT_NEAR(outline_of({triangle, 1}).at_unit_density.mass, 1, 1e-15);
}

// Random control points: chords stay within the tolerance of the curve by its definition, and reach both ends.
TEST(Spline, stays_within_its_tolerance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  std::uniform_int_distribution<int> degrees(1, 5), more(0, 9);
  for (int drawn = 0; drawn < 40; ++drawn) {
    Spline spline;
    spline.degree = degrees(random);
    const int count = spline.degree + 1 + more(random);
    for (int i = 0; i < count; ++i) spline.points.push_back({place(random), place(random)});
    spline.tolerance = 1e-4;
    const auto line = sampled(spline);
    EXPECT_LT((line.front() - spline.points.front()).norm(), 1e-12);
    EXPECT_LT((line.back() - spline.points.back()).norm(), 1e-12);
    for (int k = 0; k <= 500; ++k) {
      const auto x = on_clamped(spline.points, static_cast<std::size_t>(spline.degree), k / 500.);
      EXPECT_LT(distance_to(line, x), 1.1 * spline.tolerance) << drawn << " at " << k / 500.;
    }
  }
}

// A uniform cubic on n points of the unit circle is a circle of radius (2 + cos(2 pi/n))/3 at its knots; between them it is
// off by a term of fourth order in 2 pi/n.
TEST(Spline, closed_through_points_of_a_circle_is_round) {
  const int n = 40;
  const double radius = (2 + std::cos(2 * pi / n)) / 3;
  const auto shape = outline_of({on_circle(n), 3, true});
  EXPECT_NEAR(shape.at_unit_density.mass, pi * radius * radius, 2 * std::pow(2 * pi / n, 4));
  EXPECT_LT(shape.at_unit_density.centre.norm(), 1e-9);
  for (const Vec<2> x : shape.surface.vertices.colwise()) EXPECT_NEAR(x.norm(), radius, std::pow(2 * pi / n, 4));
}

// Green's theorem on the parabola of three control points: two thirds of what the control triangle encloses.
TEST(Spline, parabola_encloses_two_thirds_of_its_triangle) {
  for (const Points& points : {Points{{0, 0}, {1, 2}, {2, 0}}, Points{{2, 0}, {1, 2}, {0, 0}}}) {
    const auto shape = outline_of({points, 2});
    EXPECT_NEAR(shape.at_unit_density.mass, 4. / 3, 1e-7);
    EXPECT_NEAR(shape.at_unit_density.centre.x(), 1, 1e-7);
    EXPECT_NEAR(shape.at_unit_density.centre.y(), 0.4, 1e-7);  // of 4 t (1 - t) over [0, 1]: 2/5 of its height 1
    EXPECT_NEAR(signed_area(Points(shape.surface.vertices.colwise().begin(), shape.surface.vertices.colwise().end())),
                4. / 3, 1e-3);
  }
}

TEST(Spline, repeated_points_are_corners) {
  // A square with its corners three times each: straight between them.
  Points points;
  for (const Vec<2>& corner : {Vec<2>(0, 0), {1, 0}, {1, 1}, {0, 1}}) points.insert(points.end(), 3, corner);
  const auto shape = outline_of({points, 3, true});
  EXPECT_NEAR(shape.at_unit_density.mass, 1, 1e-9);
  for (const Vec<2> x : shape.surface.vertices.colwise())
    EXPECT_NEAR((x - Vec<2>(0.5, 0.5)).lpNorm<Eigen::Infinity>(), 0.5, 1e-12);
}

// Paraboloid r^2 = z under z = 1: volume pi/2, centre at 2/3.
TEST(Spline, revolved_encloses_the_volume_of_the_curve) {
  const auto bowl = solid_of(Spline{{{0, 0}, {0.5, 0}, {1, 1}}, 2});
  EXPECT_NEAR(bowl.at_unit_density.mass, pi / 2, 1e-6);
  EXPECT_NEAR(bowl.at_unit_density.centre.z(), 2. / 3, 1e-6);
  EXPECT_NEAR(mass_properties(bowl.surface).mass, pi / 2, 2e-3);  // facets about the axis: 0.04 %
}

TEST(Spline, refuses_what_is_no_outline) {
  EXPECT_THROW(sampled({{{0, 0}, {1, 0}, {1, 1}}, 3}), std::invalid_argument);              // too few
  EXPECT_THROW(sampled({{{0, 0}, {1, 0}}, 1, true}), std::invalid_argument);                // too few to close
  EXPECT_THROW(sampled({{{0, 0}, {1, 0}, {1, 1}}, 0}), std::invalid_argument);              // degree
  EXPECT_THROW(sampled({{{0, 0}, {NAN, 0}, {1, 1}}, 2}), std::invalid_argument);            // not finite
  EXPECT_THROW(outline_of({{{0, 0}, {3, 1}, {-2, 1}, {1, 0}}, 3}), std::invalid_argument);  // crosses itself
  EXPECT_THROW(sampled({on_circle(9), 3, true, 1e-13}), std::invalid_argument);         // more chords than anyone wants
  EXPECT_THROW(solid_of(Spline{on_circle(9), 3, true}), std::invalid_argument);         // no profile
  EXPECT_THROW(solid_of(Spline{{{0, 0}, {-1, 1}, {0, 2}}, 2}), std::invalid_argument);  // beyond the axis
}

}  // namespace
}  // namespace splashdown::rigid::spline_test
