// Bodies in space: closed, outward, on the exact surface, well-shaped, with the mass properties of the exact shape.
#include "rigid/shapes/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::solids_test {

namespace {

using std::numbers::pi;
using Profile = std::vector<Vec<2>>;

const Profile& buoy() {
  static const Profile profile{{0, 0}, {0.5, 0.1}, {0.8, 0.6}, {0.3, 0.7}, {0.3, 1.5}};
  return profile;
}

std::vector<Shape<3>> all(int around = default_around) {
  return {sphere(0.7, around), box({1, 0.4, 0.2}), cone(pi / 6, 0.5, around), capsule_of_revolution(0.3, 1, around),
          revolved(buoy(), around)};
}

Vec<3> normal(const Surface<3>& s, Eigen::Index f) {
  const Vec<3> a = s.vertices.col(s.facets(0, f)), b = s.vertices.col(s.facets(1, f)),
               c = s.vertices.col(s.facets(2, f));
  return (b - a).cross(c - a).normalized();
}

/// Angles between the normals of neighbouring triangles [deg].
std::vector<double> turns(const Surface<3>& s) {
  std::map<std::pair<int, int>, Eigen::Index> facet_of;
  for (Eigen::Index f = 0; f < s.facets.cols(); ++f)
    for (int k = 0; k < 3; ++k) facet_of[{s.facets(k, f), s.facets((k + 1) % 3, f)}] = f;
  std::vector<double> angles;
  for (const auto& [edge, f] : facet_of)
    angles.push_back(std::acos(std::min(1., normal(s, f).dot(normal(s, facet_of.at({edge.second, edge.first}))))) *
                     180 / pi);
  return angles;
}

}  // namespace

TEST(Solids, are_closed_and_oriented) {
  for (const auto& shape : all()) {
    const auto& s = shape.surface;
    std::map<std::pair<int, int>, int> uses;
    for (Eigen::Index f = 0; f < s.facets.cols(); ++f)
      for (int k = 0; k < 3; ++k) ++uses[{s.facets(k, f), s.facets((k + 1) % 3, f)}];
    for (const auto& [edge, count] : uses) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(uses.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(s.vertices.cols() - 3 * s.facets.cols() / 2 + s.facets.cols(), 2) << "one piece without holes (Euler)";
    EXPECT_GT(mass_properties(s).mass, 0);
  }
}

TEST(Solids, have_their_vertices_on_the_exact_surface) {
  const auto ball = sphere(0.7), capsule = capsule_of_revolution(0.3, 1), tip = cone(pi / 6, 0.5);
  for (const Vec<3> x : ball.surface.vertices.colwise()) EXPECT_NEAR(x.norm(), 0.7, 4 * eps);
  for (const Vec<3> x : capsule.surface.vertices.colwise()) {
    const Vec<3> axis(std::clamp(x.x(), -0.5, 0.5), 0, 0);
    EXPECT_NEAR((x - axis).norm(), 0.3, 4 * eps);
  }
  const double height = 0.5 * std::tan(pi / 6);
  for (const Vec<3> x : tip.surface.vertices.colwise()) {
    const double r = x.head<2>().norm(), on_side = std::abs(x.z() - r * std::tan(pi / 6)),
                 on_top = std::abs(x.z() - height);
    EXPECT_NEAR(std::min(on_side, on_top), 0, 4 * eps);
  }
}

// Triangles turn by 360/128 deg about the axis at most; the diagonals of rings of different counts add to it, less than
// as much again. Creases of 30 deg or more are then edges of the shape itself.
TEST(Solids, are_smooth_but_for_their_edges) {
  for (const auto& shape : {sphere(0.7), capsule_of_revolution(0.3, 1)})
    for (const double angle : turns(shape.surface)) EXPECT_LT(angle, 2 * 360. / default_around);
  for (const double deadrise : {5., 30., 60., 85.})
    for (const double angle : turns(cone(deadrise * pi / 180, 0.5).surface))
      EXPECT_TRUE(angle < 2 * 360. / default_around || std::abs(angle - (180 - deadrise)) < 2)
          << deadrise << " " << angle;
}

TEST(Solids, that_are_round_have_well_shaped_triangles) {
  for (const auto& shape : {sphere(0.7), capsule_of_revolution(0.3, 1)}) {
    double shortest = 1e9, longest = 0;
    const auto& s = shape.surface;
    for (Eigen::Index f = 0; f < s.facets.cols(); ++f)
      for (int k = 0; k < 3; ++k) {
        const double edge = (s.vertices.col(s.facets(k, f)) - s.vertices.col(s.facets((k + 1) % 3, f))).norm();
        shortest = std::min(shortest, edge);
        longest = std::max(longest, edge);
      }
    EXPECT_LT(longest / shortest, 2.2);
  }
}

TEST(SolidMassProperties, of_polyhedra_are_those_of_the_formulas) {
  const Shape<3> shape = box({1, 0.4, 0.2});
  const auto p = mass_properties(shape.surface);
  EXPECT_NEAR(p.mass, shape.at_unit_density.mass, 20 * eps);
  EXPECT_NEAR((p.centre - shape.at_unit_density.centre).norm(), 0, 20 * eps);
  EXPECT_NEAR((p.inertia - shape.at_unit_density.inertia).norm(), 0, 20 * eps);
}

// Polyhedra with vertices on the surface miss a share of (edge / radius)^2.
TEST(SolidMassProperties, of_surfaces_tend_to_the_formulas_at_second_order) {
  const auto coarse = all(96), fine = all(192);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    if (i == 1) continue;  // the box
    const auto error = [](const Shape<3>& shape) {
      const auto p = mass_properties(shape.surface);
      const auto& exact = shape.at_unit_density;
      EXPECT_NEAR((p.centre - exact.centre).head<2>().norm(), 0, 1e-3);
      EXPECT_NEAR(p.centre.z(), exact.centre.z(), 1e-3);
      EXPECT_NEAR((p.inertia - Eigen::Matrix3d(p.inertia.diagonal().asDiagonal())).norm(), 0, 1e-3 * p.inertia.norm());
      Eigen::Array4d e;
      e << 1 - p.mass / exact.mass, 1 - p.inertia.diagonal().array() / exact.inertia.diagonal().array();
      return e;
    };
    const Eigen::Array4d at_96 = error(coarse[i]), at_192 = error(fine[i]);
    EXPECT_GT(at_96.minCoeff(), 0) << "inside the exact surface";
    EXPECT_LT(at_96[0], 3 * 4 * pi * pi / 6 / 96 / 96) << "three times the circle's";
    const Eigen::Array4d order = (at_96 / at_192).log() / std::log(2.);
    EXPECT_NEAR(order.minCoeff(), 2, 0.2) << i;
    EXPECT_NEAR(order.maxCoeff(), 2, 0.2) << i;
  }
}

TEST(SolidMassProperties, are_the_textbook_ones) {
  const double r = 0.5, h = r * std::tan(pi / 6), m = pi * r * r * h / 3;
  const auto p = cone(pi / 6, r).at_unit_density;
  EXPECT_NEAR(p.mass, m, 4 * eps);
  EXPECT_NEAR(p.centre.z(), 0.75 * h, 4 * eps);
  EXPECT_NEAR(p.inertia(2, 2), 0.3 * m * r * r, 4 * eps);
  EXPECT_NEAR(p.inertia(0, 0), 3. / 80 * m * (4 * r * r + h * h), 4 * eps);
  const auto ball = sphere(2).at_unit_density;
  EXPECT_NEAR(ball.mass, 4. / 3 * pi * 8, 20 * eps);
  EXPECT_NEAR(ball.inertia(1, 1), 0.4 * 4 * ball.mass, 200 * eps);
}

TEST(Sphere, reaches_its_radius_on_every_axis) {
  const auto ball = sphere(0.7);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(ball.surface.vertices.row(k).minCoeff(), -0.7, 2 * eps);
    EXPECT_NEAR(ball.surface.vertices.row(k).maxCoeff(), 0.7, 2 * eps);
  }
}

TEST(Revolved, is_the_same_from_either_end) {
  const Profile reversed(buoy().rbegin(), buoy().rend());
  const auto one = revolved(buoy()), other = revolved(reversed);
  EXPECT_EQ(one.surface.vertices, other.surface.vertices);
  EXPECT_EQ(one.surface.facets, other.surface.facets);
}

TEST(Solids, that_are_none_are_refused_with_rule_and_value) {
  EXPECT_EQ(failure([] { sphere(-1); }), "sphere: radius is -1; it must be positive");
  EXPECT_EQ(failure([] { sphere(1, 4); }), "sphere: 4 edges around; at least 8");
  EXPECT_EQ(failure([] { box(Vec<3>(1, 0, 1)); }), "box: length along y is 0; it must be positive");
  EXPECT_TRUE(says(failure([] { cone(2, 1); }), "between 0 and 90"));
  EXPECT_EQ(failure([] { capsule_of_revolution(1, 0); }), "capsule: straight length is 0; it must be positive");
  EXPECT_TRUE(says(failure([] { revolved(Profile{{0, 0}}); }), "1 points"));
  EXPECT_TRUE(says(failure([] { revolved(Profile{{0, 0}, {-1, 1}, {0, 2}}); }), "point 2 (-1, 1)"));
  EXPECT_TRUE(says(failure([] { revolved(Profile{{0, 0}, {1, 1}, {0, 2}, {1, 3}, {0, 4}}); }), "touch or cross"));
  EXPECT_TRUE(says(failure([] { revolved(Profile{{0, 0}, {1, 1}, {1, 1}, {0, 2}}); }), "points 2 and 3 are the same"));
  EXPECT_TRUE(says(failure([] { revolved(Profile{{0.5, 1e6}, {0.5, 0.1}}); }), "too long for its width"));
  EXPECT_TRUE(says(failure([] { capsule_of_revolution(1e-3, 1e6); }), "too long for its width"));
}

}  // namespace splashdown::rigid::solids_test
