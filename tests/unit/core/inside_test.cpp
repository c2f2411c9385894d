#include "core/surface/inside.hpp"

#include <gtest/gtest.h>

#include "core/closest_point.hpp"
#include "core/facet_tree.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::inside_test {
namespace {

template <int d>
struct Boundary {
  std::vector<Vec<d>> x;
  std::vector<Facet<d>> facets;
};

void add_ring(Boundary<2>& b, const Surface<2>& s) {
  const int first = static_cast<int>(b.x.size());
  for (int v = 0; v < s.vertices.cols(); ++v) b.x.push_back(s.vertices.col(v));
  for (int f = 0; f < s.facets.cols(); ++f) b.facets.push_back({{first + s.facets(0, f), first + s.facets(1, f)}, -1});
}

// How often the boundary runs around the point, from the angles under which its facets are seen.
int winding(const Boundary<2>& b, const Vec<2>& at) {
  double angle = 0;
  for (const auto& f : b.facets) {
    const Vec<2> p = b.x[f.nodes[0]] - at, q = b.x[f.nodes[1]] - at;
    angle += std::atan2(p.x() * q.y() - p.y() * q.x(), p.dot(q));
  }
  return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

bool on_boundary(const Boundary<2>& b, const Vec<2>& at) {
  for (const auto& f : b.facets)
    if ((closest_on({b.x[f.nodes[0]], b.x[f.nodes[1]]}, at) - at).norm() < 1e-9) return true;
  return false;
}

void expect_like_winding(const Boundary<2>& b, const std::vector<Vec<2>>& points) {
  const InsideTest<2> inside(b.x, b.facets);
  for (const auto& p : points) {
    if (on_boundary(b, p)) continue;
    EXPECT_EQ(inside(p), winding(b, p) > 0) << p.transpose();
    EXPECT_EQ(is_inside<2>(b.x, b.facets, p), inside(p)) << p.transpose();
  }
}

std::vector<Vec<2>> cloud(int count, double radius) {
  std::mt19937 random(3);
  std::vector<Vec<2>> points(count);
  for (auto& p : points) p = radius * scenes::random_vector<Vec<2>>(random, {});
  return points;
}

Surface<2> star(int spikes, double sharpness) {
  std::vector<Vec<2>> p;
  for (int i = 0; i < 2 * spikes; ++i) {
    const double r = i % 2 ? sharpness : 1, angle = std::numbers::pi * i / spikes;
    p.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return scenes::outline(p);
}

TEST(InsideTest2, agrees_with_the_winding_number) {
  for (int spikes : {2, 3, 7, 100}) {
    Boundary<2> b;
    add_ring(b, star(spikes, 0.3));
    expect_like_winding(b, cloud(2000, 1.1));
  }
}

TEST(InsideTest2, agrees_at_the_height_of_corners_and_of_level_facets) {
  Boundary<2> b;
  add_ring(b, scenes::outline({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}));
  std::vector<Vec<2>> points;
  for (double y : {0.0, 1.0, 2.0})
    for (double x = -0.45; x < 4; x += 0.1) points.push_back({x, y});
  expect_like_winding(b, points);
}

TEST(InsideTest2, holes_are_outside_and_islands_in_them_inside) {
  Boundary<2> b;
  add_ring(b, scenes::ellipse(1, 1, 40));
  add_ring(b, scenes::turned_inside_out(scenes::ellipse(0.6, 0.6, 30)));
  add_ring(b, scenes::ellipse(0.3, 0.3, 20));
  expect_like_winding(b, cloud(2000, 1.1));
}

TEST(InsideTest2, overlap_is_inside) {
  Boundary<2> b;
  add_ring(b, scenes::ellipse(1, 1, 40, {-0.5, 0}));
  add_ring(b, scenes::ellipse(1, 1, 40, {0.5, 0}));
  EXPECT_TRUE(InsideTest<2>(b.x, b.facets)({0, 0}));
  expect_like_winding(b, cloud(2000, 1.6));
}

TEST(InsideTest2, a_boundary_graded_a_millionfold_is_no_harder) {
  std::vector<Vec<2>> p{{0, 0}};
  for (double s = 1e-6; s < 1; s *= 1.2) p.push_back({s, s * s});
  p.push_back({1, 2});
  Boundary<2> b;
  add_ring(b, scenes::outline(p));
  expect_like_winding(b, cloud(2000, 1.1));
}

TEST(InsideTest2, of_no_boundary_everything_is_outside) {
  const Boundary<2> b;
  EXPECT_FALSE(InsideTest<2>(b.x, b.facets)({0, 0}));
}

void expect_cube(const std::vector<Vec<3>>& points) {
  const scenes::Lattice<3> cube(4);
  const InsideTest<3> inside(cube.nodes.x, cube.mesh.boundary);
  for (const auto& p : points) {
    const double depth = (Vec<3>::Constant(0.5) - (p - Vec<3>::Constant(0.5)).cwiseAbs()).minCoeff();
    if (std::abs(depth) < 1e-9) continue;
    EXPECT_EQ(inside(p), depth > 0) << p.transpose();
    EXPECT_EQ(is_inside<3>(cube.nodes.x, cube.mesh.boundary, p), inside(p)) << p.transpose();
  }
}

TEST(InsideTest3, knows_the_inside_of_a_cube) {
  std::mt19937 random(4);
  std::vector<Vec<3>> points(2000);
  for (auto& p : points) p = Vec<3>::Constant(0.5) + 0.7 * scenes::random_vector<Vec<3>>(random, {});
  expect_cube(points);
}

TEST(InsideTest3, counts_a_ray_through_edges_and_corners_once) {
  std::vector<Vec<3>> points;
  for (double x : {-0.125, 0.125, 0.6, 1.1})
    for (int j = 0; j <= 8; ++j)
      for (int k = 0; k <= 8; ++k) points.push_back({x, 0.125 * j, 0.125 * k});
  expect_cube(points);
}

// A mast: facets that pile up behind each other along the rays. A million of them took gigabytes of bins.
TEST(InsideTest3, knows_the_inside_of_a_long_mast_of_many_rings) {
  constexpr int around = 12, rings = 6000;
  constexpr double length = 10;
  Boundary<3> mast;
  const auto at = [](int ring, int k) { return ring * around + (k + around) % around; };
  const auto radius = [](int ring) { return 0.05 + 0.01 * ring / rings; };
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around, r = radius(ring);
      mast.x.emplace_back(r * std::cos(angle), r * std::sin(angle), length * ring / (rings - 1));
    }
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      mast.facets.push_back({{at(ring, k), at(ring, k + 1), at(ring + 1, k)}, -1});
      mast.facets.push_back({{at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)}, -1});
    }
  for (int k = 1; k + 1 < around; ++k) {
    mast.facets.push_back({{at(0, 0), at(0, k + 1), at(0, k)}, -1});
    mast.facets.push_back({{at(rings - 1, 0), at(rings - 1, k), at(rings - 1, k + 1)}, -1});
  }
  const InsideTest<3> inside(mast.x, mast.facets);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-0.07, 0.07), along(-1, length + 1);
  for (int i = 0; i < 200; ++i) {
    const Vec<3> p(across(random), across(random), along(random));
    EXPECT_EQ(inside(p), is_inside<3>(mast.x, mast.facets, p)) << p.transpose();
  }
  EXPECT_TRUE(inside({0, 0, 0.5 * length}));
  EXPECT_FALSE(inside({0, 0, 1.01 * length}));
}

}  // namespace
}  // namespace splashdown::fluid::inside_test
