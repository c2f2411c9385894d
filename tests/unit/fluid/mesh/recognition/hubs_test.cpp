#include "fluid/pfem/mesh/recognition/hubs.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "fluid/pfem/mesh/delaunay/moving_delaunay.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::hubs_test {
namespace {

using Cell = std::array<int, 4>;

/// Evenly spread over the unit sphere below z = top: a golden angle from one to the next (Vogel 1979).
std::vector<Vec<3>> on_cap(double top, double radius, double spacing) {
  const double area = 2 * std::numbers::pi * (1 + top);
  const int count = static_cast<int>(area / (spacing * spacing));
  std::vector<Vec<3>> points;
  for (int i = 0; i < count; ++i) {
    const double z = -1 + (i + 0.5) / count * (1 + top), angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    points.emplace_back(radius * r * std::cos(angle), radius * r * std::sin(angle), radius * z);
  }
  return points;
}

/// Meridians and circles of latitude.
Surface<3> sphere(int around) {
  const int circles = around / 2 - 1;
  Surface<3> s{Eigen::Matrix3Xd(3, circles * around + 2), Eigen::Matrix3Xi(3, 2 * circles * around)};
  const int bottom = circles * around, top = bottom + 1;
  s.vertices.col(bottom) << 0, 0, -1;
  s.vertices.col(top) << 0, 0, 1;
  int f = 0;
  for (int i = 0; i < circles; ++i)
    for (int j = 0; j < around; ++j) {
      const double polar = std::numbers::pi * (i + 1) / (circles + 1), angle = 2 * std::numbers::pi * j / around;
      s.vertices.col(i * around + j) << std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
          -std::cos(polar);
      const int next = (j + 1) % around, a = i * around + j, b = i * around + next;
      if (i == 0) s.facets.col(f++) << bottom, b, a;
      if (i + 1 == circles) {
        s.facets.col(f++) << top, a, b;
      } else {
        s.facets.col(f++) << a, b, a + around;
        s.facets.col(f++) << b, b + around, a + around;
      }
    }
  return s;
}

// A sphere that has dipped into water of three elements' depth under it.
struct DippedSphere {
  double h = 0.06;
  std::vector<Wall<3>> walls;
  std::vector<WallPlace<3>> poses{Isometry<3>::Identity()};
  Nodes<3> nodes;

  DippedSphere() {
    walls.emplace_back(scenes::wall("sphere", sphere(120), h));
    std::mt19937 random(3);
    for (int layer = 0; layer <= 3; ++layer)
      for (Vec<3> x : on_cap(-0.6, 1 + layer * h, h)) {
        if (layer > 0) x += 0.2 * h * scenes::random_vector<Vec<3>>(random, {});
        nodes.add(x, Vec<3>::Zero(), 0, layer == 0 ? WallTie{0, 0} : WallTie{}, false, h);
      }
  }
  WallsAt<3> at() const { return {walls, poses}; }
  Delaunay<3> triangulated(const std::vector<Vec<3>>& hubs) const {
    return MovingDelaunay<3>().follow(nodes.x, std::vector<int>(nodes.size(), -1), {}, hubs);
  }
  bool is_on_hull(const Cell& cell) const {
    return std::ranges::all_of(cell, [&](int n) { return nodes.tie[n].wall == 0; });
  }
};

TEST(Hubs, are_for_hulls_of_many_elements_that_are_wet) {
  DippedSphere dipped;
  const auto hubs = hubs_of<3>(dipped.nodes, dipped.at());
  ASSERT_EQ(hubs.size(), 1u);
  EXPECT_EQ(hubs[0].wall, 0);
  EXPECT_LE(hubs[0].x.norm(), 1e-9);
  auto coarse = dipped.nodes;
  coarse.h.assign(coarse.size(), 0.07);  // 2 * 8 h is more than the radius
  EXPECT_TRUE(hubs_of<3>(coarse, dipped.at()).empty());
  auto dry = dipped.nodes;
  dry.tie.assign(dry.size(), WallTie{});
  EXPECT_TRUE(hubs_of<3>(dry, dipped.at()).empty());
  const std::vector<Wall<3>> tank{Wall<3>(scenes::wall("", scenes::turned_inside_out(sphere(120)), 0.06))};
  EXPECT_TRUE(hubs_of<3>(dipped.nodes, WallsAt<3>{tank, dipped.poses}).empty());
}

TEST(Hubs, take_the_cells_in_the_solid_and_none_beyond_the_hull) {
  const DippedSphere dipped;
  const auto without = dipped.triangulated({});
  const auto with = dipped.triangulated({hubs_of<3>(dipped.nodes, dipped.at())[0].x});
  const auto on_hull = [&](const Cell& cell) { return dipped.is_on_hull(cell); };
  EXPECT_GT(std::ranges::count_if(without.cells, on_hull), 100);
  EXPECT_EQ(std::ranges::count_if(with.cells, on_hull), 0);
  const std::set<Cell> before(without.cells.begin(), without.cells.end()), after(with.cells.begin(), with.cells.end());
  for (const Cell& cell : after) EXPECT_TRUE(before.contains(cell)) << "Delaunay is what it is";
  for (const Cell& cell : before) {
    if (after.contains(cell)) continue;
    Vec<3> centroid = Vec<3>::Zero();
    for (int n : cell) centroid += dipped.nodes.x[n] / 4;
    EXPECT_LT(centroid.norm(), 1) << "taken by the hub";
  }
  EXPECT_EQ(with.first_hub, static_cast<int>(dipped.nodes.size()));
  for (const Cell& cell : with.at_hubs) EXPECT_TRUE(std::ranges::count(cell, with.first_hub) == 1);
}

TEST(Hubs, that_have_water_around_them_are_told) {
  const DippedSphere dipped;
  const auto block = scenes::block({-2, -2, -1.3}, {2, 2, -1.01});  // holds water below the hull
  std::vector<Vec<3>> corners;
  for (int v = 0; v < block.vertices.cols(); ++v) corners.emplace_back(block.vertices.col(v));
  std::vector<Facet<3>> facets;
  for (int f = 0; f < block.facets.cols(); ++f)
    facets.push_back({{block.facets(0, f), block.facets(1, f), block.facets(2, f)}});
  const InsideTest<3> inside(corners, facets);
  for (const double z : {0.0, -1.1}) {
    const std::vector<Hub<3>> hubs{{0, {0, 0, z}}};
    EXPECT_EQ(reach_water<3>(dipped.triangulated({hubs[0].x}), hubs, dipped.nodes, inside), z < -1) << z;
  }
}

TEST(Hubs, are_followed_where_they_go) {
  DippedSphere dipped;
  MovingDelaunay<3> triangulation;
  std::vector<int> before(dipped.nodes.size(), -1);
  const std::vector<Vec<3>> none;
  Vec<3> hub = Vec<3>::Zero();
  for (const bool has_hub : {true, true, false, true}) {
    const std::vector<Vec<3>> hubs = has_hub ? std::vector{hub} : none;
    const auto followed = triangulation.follow(dipped.nodes.x, before, {}, hubs);
    const auto anew = dipped.triangulated(hubs);
    EXPECT_TRUE(followed.cells == anew.cells);
    EXPECT_TRUE(followed.neighbours == anew.neighbours);
    EXPECT_TRUE(followed.at_hubs == anew.at_hubs);
    std::iota(before.begin(), before.end(), 0);
    for (auto& x : dipped.nodes.x) x.z() -= 1e-3;
    hub.z() -= 1e-3;
  }
  EXPECT_GE(triangulation.followed(), 1);
}

}  // namespace
}  // namespace splashdown::fluid::hubs_test
