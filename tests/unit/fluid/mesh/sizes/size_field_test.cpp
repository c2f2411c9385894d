#include "fluid/pfem/mesh/sizes/size_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::size_field_test {
namespace {

using scenes::eps;

struct Pool {
  explicit Pool(SizeSpec size) {
    spec.size = size;
    spec.liquids.push_back({scenes::rectangle({-2, -2}, {2, 0}), {}});
    spec.walls.push_back(scenes::wall("buoy", scenes::ellipse(0.3, 0.3, 32, {0.5, -0.4}), 0.02));
    spec.walls.push_back(scenes::wall("tank", scenes::turned_inside_out(scenes::rectangle({-2, -2}, {2, 1})), 0.4));
    placed.emplace(spec);
    // The surface alone is what the size field looks at; its facets are long here.
    for (double x : {-2.0, -1.0, 0.0, 1.0, 2.0}) nodes.push_back({-x, 0});
    for (int i = 0; i < 4; ++i) mesh.boundary.push_back({{i, i + 1}, -1});
  }
  SizeField<2> field(std::vector<double> wetted = {0, 0}) const {
    return {spec.size, placed->at(), wetted, nodes, mesh};
  }

  FluidSpec<2> spec;
  std::optional<scenes::Placed> placed;
  std::vector<Vec<2>> nodes;
  Mesh<2> mesh;
};

constexpr SizeSpec graded{.surface = 0.05, .far = 0.3, .growth = 0.15};

TEST(SizeField, grows_no_faster_than_its_growth) {
  const Pool pool(graded);
  const auto h = pool.field();
  std::mt19937 random(1);
  for (int sample = 0; sample < 5000; ++sample) {
    const Vec<2> a = 2 * scenes::random_vector<Vec<2>>(random, {});
    const Vec<2> b = a + (sample % 2 ? 1 : 0.01) * scenes::random_vector<Vec<2>>(random, {});
    EXPECT_LE(std::abs(h(a) - h(b)), graded.growth * (a - b).norm() + 10 * eps);
  }
}

TEST(SizeField, is_the_smallest_of_all_sources) {
  const Pool pool(graded);
  const auto h = pool.field();
  std::mt19937 random(2);
  const Wall<2>& buoy = pool.placed->walls[0];
  for (int sample = 0; sample < 1000; ++sample) {
    const Vec<2> x(2 * scenes::random_vector<Vec<2>>(random, {}));
    const double to_buoy = std::abs(buoy.nearest(Isometry<2>::Identity(), x, 100).distance);
    const double to_tank = std::min({2 - std::abs(x.x()), x.y() + 2, 1 - x.y()});
    if (to_tank < 0) continue;
    const double expected = std::min({0.3, 0.02 + 0.15 * to_buoy, 0.4 + 0.15 * to_tank, 0.05 + 0.15 * std::abs(x.y())});
    EXPECT_NEAR(h(x), expected, 10 * eps);
  }
}

TEST(SizeField, follows_the_wetted_length_of_a_wall) {
  SizeSpec spec = graded;
  spec.wetted_fraction = 0.1;
  const Pool pool(spec);
  EXPECT_EQ(pool.field({0.1, 0}).at_wall(0), 0.02) << "not below the wall's own size";
  EXPECT_NEAR(pool.field({1.0, 0}).at_wall(0), 0.1 * 0.5, eps);
  EXPECT_NEAR(pool.field({1.0, 0})({0.5, -0.7}), 0.05, 10 * eps);
}

TEST(SizeField, a_surface_coarser_than_far_is_no_source) {
  SizeSpec spec = graded;
  spec.surface = 1;
  const Pool pool(spec);
  EXPECT_EQ(pool.field()({-1.9, 0}), 0.3) << "far from the buoy, beside the tank's 0.4";
}

// A drop with a notch of radius R: nodes on the notch have normals that point at its centre.
struct Notched {
  static constexpr double R = 0.2;
  explicit Notched(double hollow, double hollow_min = 0) {
    size = {.surface = 0.3, .far = 0.3, .growth = 0.15, .hollow = hollow, .hollow_min = hollow_min};
    std::vector<Vec<2>> p{{-1, 0}, {-1, -1}, {1, -1}, {1, 0}};
    const int n = 24;
    for (int i = 0; i <= n; ++i) {
      const double angle = std::numbers::pi * i / n;
      p.push_back({R * std::cos(angle), -R * std::sin(angle)});
    }
    const int count = static_cast<int>(p.size());
    for (const auto& x : p) nodes.add(x, Vec<2>::Zero(), 0, {}, true);
    for (int i = 0; i < count; ++i) mesh.boundary.push_back({{i, (i + 1) % count}, -1});
    nodes.add({0, -0.3}, Vec<2>::Zero(), 0, {}, false);  // an inner node: this is bulk, not a sheet
    nodes.h.assign(nodes.size(), 0.3);                   // narrow cells across the notch do not join its sides
    mesh = recognise<2>(nodes, mesh.boundary, WallsAt<2>{});
  }
  SizeField<2> field() const { return {size, WallsAt<2>{}, {}, nodes.x, mesh}; }
  SizeSpec size;
  Nodes<2> nodes;
  Mesh<2> mesh;
};

TEST(SizeField, a_hollow_of_the_surface_is_meshed_by_its_radius) {
  const Notched notched(0.25);
  const auto h = notched.field();
  // Equal facets on a circle: the nodes' normals are radial and the discrete curvature is 1 / R exactly.
  EXPECT_NEAR(h({0, -Notched::R}), 0.25 * Notched::R, 100 * eps);
  EXPECT_NEAR(h({0, -Notched::R - 0.1}), 0.25 * Notched::R + 0.15 * 0.1, 100 * eps);
  EXPECT_EQ(h({0.9, -0.9}), std::min(0.3, h({0.9, -0.9})));
}

TEST(SizeField, hollows_have_a_smallest_size) {
  EXPECT_NEAR(Notched(0.25, 0.1).field()({0, -Notched::R}), 0.1, 100 * eps);
}

TEST(SizeField, no_hollow_is_sought_unless_asked_for) {
  EXPECT_EQ(Notched(std::numeric_limits<double>::infinity()).field()({0, -Notched::R}), 0.3);
}

TEST(SizeField, a_bulge_is_no_hollow) {
  FluidSpec<2> spec;
  spec.size = {.surface = 0.1, .far = 0.1};
  spec.liquids.push_back({scenes::ellipse(0.5, 0.5, 64), {}});
  const scenes::Placed none(spec);
  const auto drop = fill<2>(spec, none.at());
  SizeSpec size{.surface = 0.1, .far = 0.1, .hollow = 0.01};
  const SizeField<2> h(size, none.at(), {}, drop.nodes.x, drop.mesh);
  for (const auto& x : drop.nodes.x) EXPECT_EQ(h(x), 0.1);
}

// Element size at a point near a hull of elements of 0.05 m.
double size_at_hull(const Surface<2>& hull, const Vec<2>& x, double curvature = 0.5, double corner = 1) {
  FluidSpec<2> spec;
  spec.walls.push_back(scenes::wall("hull", hull, 0.05));
  const scenes::Placed placed(spec);
  SizeSpec size = graded;
  size.surface = 1;
  size.curvature = curvature;
  size.corner = corner;
  return SizeField<2>(size, placed.at(), std::vector{0.0}, {}, {})(x);
}

TEST(SizeField, tight_curves_of_a_hull_are_meshed_by_their_radius) {
  const double a = 0.5, b = 0.2, radius = b * b / a;
  const auto hull = scenes::ellipse(a, b, 256);
  const double turn = 2 * std::numbers::pi * a / b / 256;  // of a facet at the tip: the polygon's error of the radius
  EXPECT_NEAR(size_at_hull(hull, {a, 0}), 0.5 * radius, 0.5 * radius * turn * turn);
  EXPECT_NEAR(size_at_hull(hull, {-a - 0.1, 0}, 0.25), 0.25 * radius + 0.15 * 0.1, 0.25 * radius * turn * turn);
  EXPECT_EQ(size_at_hull(hull, {0, b}), 0.05) << "the sides are flat";
  EXPECT_EQ(size_at_hull(hull, {a, 0}, 1), 0.05) << "resolved as it is";
  EXPECT_NEAR(size_at_hull(scenes::ellipse(0.2, 0.02, 256), {0.2, 0}), 0.25 * 0.05, eps) << "a quarter at least";
}

TEST(SizeField, corners_of_a_hull_are_no_curves) {
  EXPECT_EQ(size_at_hull(scenes::rectangle({-0.01, -0.5}, {0.01, 0.5}), {0.01, 0.5}), 0.05);
  const double low = -std::tan(std::numbers::pi / 18);  // the keel of a wedge of 10 degrees turns by 20
  EXPECT_EQ(size_at_hull(scenes::outline({{0, low}, {1, 0}, {1, 1}, {-1, 1}, {-1, 0}}), {0, low}), 0.05);
}

TEST(SizeField, corners_of_a_hull_are_as_small_as_asked_for) {
  const auto box = scenes::rectangle({-0.5, -0.5}, {0.5, 0.5});
  EXPECT_NEAR(size_at_hull(box, {0.5, -0.5}, 0.5, 0.2), 0.2 * 0.05, eps);
  EXPECT_NEAR(size_at_hull(box, {0.4, -0.5}, 0.5, 0.2), 0.2 * 0.05 + 0.15 * 0.1, eps) << "and grow from there";
  EXPECT_EQ(size_at_hull(box, {0, -0.5}, 0.5, 0.2), 0.05);
  EXPECT_EQ(size_at_hull(scenes::ellipse(0.5, 0.4, 256), {0.5, 0}, 0.5, 0.2), 0.05) << "a curve has none";
}

/// What all sources together ask for, one by one.
template <int d>
void a_tree_of_sources_asks_for_what_they_all_ask(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1), size(1e-3, 0.1);
  const double growth = 0.1, far = 0.15;
  const auto anywhere = [&] {
    Vec<d> x;
    for (int k = 0; k < d; ++k) x(k) = place(random);
    return x;
  };
  std::vector<SizeSource<d>> all;
  SizeSources<d> sources(growth);
  for (int i = 0; i < count; ++i) {
    // Some at one place: halves of a tree must not depend on points that differ.
    all.push_back({i % 5 == 0 ? Vec<d>(Vec<d>::Constant(0.25)) : anywhere(), size(random)});
    sources.add(all.back());
  }
  for (const bool planted : {false, true}) {
    if (planted) sources.plant();
    for (int i = 0; i < 500; ++i) {
      const Vec<d> x = anywhere();
      double h = far;
      for (const auto& s : all) h = std::min(h, s.size + growth * (s.at - x).norm());
      EXPECT_NEAR(sources.least(x, far), h, 4 * eps * far) << (planted ? "a tree" : "as they come");
    }
  }
}

TEST(SizeSources, a_tree_asks_for_what_all_ask_for) {
  for (const int count : {0, 1, 8, 9, 63, 64, 65, 300}) {
    a_tree_of_sources_asks_for_what_they_all_ask<2>(count);
    a_tree_of_sources_asks_for_what_they_all_ask<3>(count);
  }
}

}  // namespace
}  // namespace splashdown::fluid::size_field_test
