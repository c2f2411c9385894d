#include "fluid/pfem/mesh/adapt/adapt.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "fluid/pfem/initial/parts.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::adapt_test {
namespace {

using scenes::eps;

struct Tank {
  explicit Tank(double h0) : spec(scenes::still_water(1, 1, h0)), placed(spec), liquid(fill<2>(spec, placed.at())) {}

  AdaptReport<2> sweep() {
    const auto report = adapt<2>(liquid.nodes, liquid.mesh, placed.at());
    after_adapt = liquid.mesh.boundary;
    liquid.nodes.h.assign(liquid.nodes.size(), target);
    liquid.mesh = recognise<2>(liquid.nodes, liquid.mesh.boundary, placed.at());
    return report;
  }
  AdaptReport<2> retarget(double h) {
    target = h;
    liquid.nodes.h.assign(liquid.nodes.size(), h);
    return sweep();
  }
  // Length over h of the edges: shortest and longest.
  std::pair<double, double> spacing() const {
    double least = 1e300, most = 0;
    for (const auto& cell : liquid.mesh.cells)
      for (int k = 0; k < 3; ++k) {
        const double ratio = (liquid.nodes.x[cell[k]] - liquid.nodes.x[cell[(k + 1) % 3]]).norm() / target;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
    return {least, most};
  }
  double area() const { return enclosed_volume(liquid.mesh.boundary, liquid.nodes.x); }

  FluidSpec<2> spec;
  scenes::Placed placed;
  InitialLiquid<2> liquid;
  std::vector<Facet<2>> after_adapt;
  double target = 0;
};

TEST(Adapt, leaves_a_mesh_alone_that_fits) {
  Tank tank(0.1);
  const auto x = tank.liquid.nodes.x;
  const auto report = tank.retarget(0.1);
  EXPECT_LE(report.inserted + report.removed, static_cast<int>(x.size()) / 50);
}

class Towards : public testing::TestWithParam<double> {};

TEST_P(Towards, spacing_is_within_the_bounds_after_enough_sweeps) {
  Tank tank(0.1);
  tank.target = GetParam();
  tank.retarget(GetParam());
  int sweeps = 1;
  while (sweeps < 40) {
    const auto report = tank.sweep();
    ++sweeps;
    if (report.inserted + report.removed == 0) break;
  }
  EXPECT_LT(sweeps, 40) << "splits and merges chase each other";
  const auto [least, most] = tank.spacing();
  EXPECT_GE(least, 0.45);
  EXPECT_LE(most, 1.5);
}

TEST_P(Towards, the_boundary_stays_closed_and_on_the_walls) {
  Tank tank(0.1);
  tank.target = GetParam();
  tank.retarget(GetParam());
  for (int sweep = 0; sweep < 6; ++sweep) {
    EXPECT_TRUE(scenes::closed(tank.after_adapt, tank.liquid.nodes.size()));
    EXPECT_TRUE(scenes::closed(tank.liquid.mesh.boundary, tank.liquid.nodes.size()));
    // Straight walls, level surface, corners kept: no volume is made or lost.
    EXPECT_NEAR(tank.area(), 1, 1e4 * eps);
    for (std::size_t i = 0; i < tank.liquid.nodes.size(); ++i) {
      const auto& tie = tank.liquid.nodes.tie[i];
      if (tie.wall < 0) continue;
      const auto near = tank.placed.walls[0].nearest(tank.placed.poses[0], tank.liquid.nodes.x[i], 1);
      EXPECT_LE(std::abs(near.distance), 10 * eps);
    }
    tank.sweep();
  }
}

TEST_P(Towards, sharp_vertices_and_ends_of_contact_lines_stay) {
  Tank tank(0.1);
  tank.target = GetParam();
  tank.retarget(GetParam());
  for (int sweep = 0; sweep < 6; ++sweep) tank.sweep();
  for (const Vec<2>& kept : {Vec<2>(-0.5, -1), Vec<2>(0.5, -1), Vec<2>(-0.5, 0), Vec<2>(0.5, 0)}) {
    double nearest = 1;
    for (const auto& x : tank.liquid.nodes.x) nearest = std::min(nearest, (x - kept).norm());
    EXPECT_LE(nearest, 10 * eps) << kept.transpose();
  }
}

TEST_P(Towards, a_linear_velocity_field_and_its_momentum_are_kept) {
  Tank tank(0.1);
  tank.target = GetParam();
  Mat<2> gradient;
  gradient << 1, -2, 3, -1;
  const auto field = [&](const Vec<2>& x) -> Vec<2> { return Vec<2>(0.3, -0.7) + gradient * x; };
  auto& nodes = tank.liquid.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes.v[i] = field(nodes.x[i]);
  tank.retarget(GetParam());
  for (int sweep = 0; sweep < 6; ++sweep) tank.sweep();
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_LE((nodes.v[i] - field(nodes.x[i])).norm(), 100 * eps);
  Vec<2> momentum = Vec<2>::Zero();
  for (const auto& cell : tank.liquid.mesh.cells)
    for (int n : cell) momentum += volume<2>(corners(nodes.x, cell)) / 3 * nodes.v[n];
  EXPECT_LE((momentum - field({0, -0.5})).norm(), 1e4 * eps);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Towards, testing::Values(0.03, 0.07, 0.13, 0.25));

TEST(Adapt, removes_inner_nodes_that_crowd_a_facet) {
  Tank tank(0.1);
  tank.target = 0.1;
  auto& nodes = tank.liquid.nodes;
  const int crowd = nodes.add({0.013, -1 + 0.01}, Vec<2>::Zero(), 0, {}, false, 0.1);
  tank.liquid.mesh = recognise<2>(nodes, tank.liquid.mesh.boundary, tank.placed.at());
  const Vec<2> at = nodes.x[crowd];
  tank.sweep();
  for (const auto& x : nodes.x) EXPECT_GT((x - at).norm(), 1e-3);
}

// A node that has slid into a corner is one with the corner's, whatever else happens beside it: here an inner node crowds its facet.
TEST(Adapt, leaves_no_two_nodes_in_one_place_and_loses_no_volume) {
  Tank tank(0.1);
  tank.target = 0.1;
  auto& nodes = tank.liquid.nodes;
  int corner = -1, beside = -1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.tie[i].vertex >= 0 && (nodes.x[i] - Vec<2>(-0.5, -1)).norm() < eps) corner = static_cast<int>(i);
  ASSERT_GE(corner, 0);
  for (const auto& f : tank.liquid.mesh.boundary)
    for (int k : {0, 1})
      if (f.nodes[k] == corner && std::abs(nodes.x[f.nodes[1 - k]].y() + 1) < eps) beside = f.nodes[1 - k];
  ASSERT_GE(beside, 0);
  const int crowd = nodes.add(nodes.x[beside] + Vec<2>(0.002, 0.01), Vec<2>::Zero(), 0, {}, false, 0.1);
  tank.liquid.mesh = recognise<2>(nodes, tank.liquid.mesh.boundary, tank.placed.at());
  ASSERT_EQ(nodes.spray[crowd], 0);
  nodes.x[beside] = nodes.x[corner];
  nodes.volume.assign(nodes.size(), 1);
  nodes.owed.assign(nodes.size(), 0);
  const auto before = static_cast<double>(nodes.size());
  const auto report = adapt<2>(nodes, tank.liquid.mesh, tank.placed.at());
  EXPECT_GE(report.removed, 2) << "the one beside and the one in the crowd";
  EXPECT_NEAR(std::reduce(nodes.volume.begin(), nodes.volume.end()) + std::reduce(nodes.owed.begin(), nodes.owed.end()),
              before, eps)
      << "what has gone has handed on its volume";
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((nodes.x[i] - nodes.x[j]).norm(), 0) << i << " " << j;
}

// The contact lines on both sides of a gap, a tenth of an element wide, and a corner on one of them.
TEST(Adapt, does_not_merge_across_a_gap_between_walls) {
  std::vector<Wall<2>> walls;
  const std::vector<WallPlace<2>> poses(2, Isometry<2>::Identity());
  walls.emplace_back(scenes::wall("left", scenes::rectangle({-1, -1}, {0, 0}), 0.1));
  walls.emplace_back(scenes::wall("right", scenes::rectangle({0.01, -1}, {1, 1}), 0.1));
  Nodes<2> nodes;
  Mesh<2> mesh;
  const auto add = [&](double x, double y, WallTie tie, bool surface) {
    nodes.add({x, y}, Vec<2>::Zero(), 0, tie, surface, 0.1);
  };
  const WallsAt<2> at{walls, poses};
  for (const double y : {-0.2, -0.1, 0.}) add(0, y, tie_at<2>({0, y}, at), y == 0);
  for (const double y : {0., -0.1, -0.2}) add(0.01, y, tie_at<2>({0.01, y}, at), y == 0);
  ASSERT_GE(nodes.tie[2].vertex, 0);
  for (int i = 0; i < 6; ++i) mesh.boundary.push_back({{(i + 1) % 6, i}, i == 2 || i == 5 ? -1 : i < 2 ? 0 : 1});
  mesh = recognise<2>(nodes, mesh.boundary, at);
  ASSERT_EQ(mesh.cells.size(), 4u);
  EXPECT_EQ(adapt<2>(nodes, mesh, at).removed, 0);
}

// A hull stands on the floor: the node at its foot is the hull's, the next one along the floor is the tank's.
TEST(Adapt, keeps_facets_between_nodes_of_two_walls_on_the_wall_that_they_wet) {
  std::vector<Wall<2>> walls;
  const std::vector<WallPlace<2>> poses(2, Isometry<2>::Identity());
  walls.emplace_back(scenes::wall("tank", scenes::turned_inside_out(scenes::rectangle({-1, 0}, {1, 1})), 0.1));
  walls.emplace_back(scenes::wall("hull", scenes::rectangle({-0.5, 0}, {0, 0.5}), 0.1));
  const WallsAt<2> at{walls, poses};
  Nodes<2> nodes;
  Mesh<2> mesh;
  const std::vector<Vec<2>> corners{{0, 0}, {0.4, 0}, {0.4, 0.2}, {0, 0.2}};
  const auto floor = tie_at<2>(corners[1], at);
  ASSERT_EQ(floor.wall, 0);
  nodes.add(corners[0], Vec<2>::Zero(), 0, {1, -1, 1}, false, 0.1);
  nodes.add(corners[1], Vec<2>::Zero(), 0, floor, true, 0.1);
  nodes.add(corners[2], Vec<2>::Zero(), 0, {}, true, 0.1);
  nodes.add(corners[3], Vec<2>::Zero(), 0, tie_at<2>(corners[3], at), true, 0.1);
  ASSERT_LT((walls[1].vertex(poses[1], 1) - corners[0]).norm(), eps);
  const int wets[] = {0, -1, -1, 1};
  for (int i = 0; i < 4; ++i) mesh.boundary.push_back({{i, (i + 1) % 4}, wets[i]});
  mesh = recognise<2>(nodes, mesh.boundary, at);
  int on_floor = 0;
  for (int sweep = 0; sweep < 4; ++sweep) {
    adapt<2>(nodes, mesh, at);
    for (std::size_t i = 4; i < nodes.size(); ++i) {
      if (std::abs(nodes.x[i].y()) > 1e-9) continue;
      ++on_floor;
      EXPECT_EQ(nodes.tie[i].wall, 0) << nodes.x[i].transpose();
      EXPECT_FALSE(nodes.surface[i]) << nodes.x[i].transpose();
    }
    mesh = recognise<2>(nodes, mesh.boundary, at);
  }
  EXPECT_GT(on_floor, 0);
  for (const auto& f : mesh.boundary)
    if (std::abs(nodes.x[f.nodes[0]].y()) + std::abs(nodes.x[f.nodes[1]].y()) < 1e-9) {
      EXPECT_EQ(f.wall, 0);
    }
}

TEST(Adapt, does_not_merge_across_a_thin_jet) {
  // A sheet a tenth of an element thick: its two sides are closer than any merge threshold.
  std::vector<Vec<2>> p;
  for (int i = 0; i <= 20; ++i) p.push_back({i / 20.0, 0});
  for (int i = 20; i >= 0; --i) p.push_back({i / 20.0 + 1e-3, 0.005});
  Nodes<2> nodes;
  Mesh<2> mesh;
  const int n = static_cast<int>(p.size());
  for (int i = 0; i < n; ++i) {
    nodes.add(p[i], Vec<2>::Zero(), 0, {}, true, 0.05);
    mesh.boundary.push_back({{i, (i + 1) % n}, -1});
  }
  mesh = recognise<2>(nodes, mesh.boundary, WallsAt<2>{});
  const double before = enclosed_volume(mesh.boundary, nodes.x);
  ASSERT_NEAR(before, 0.005, 1e-4);
  for (int sweep = 0; sweep < 4; ++sweep) {
    adapt<2>(nodes, mesh, WallsAt<2>{});
    mesh = recognise<2>(nodes, mesh.boundary, WallsAt<2>{});
  }
  EXPECT_TRUE(scenes::closed(mesh.boundary, nodes.size()));
  // The two end faces may be merged away, nothing in between: half an element of sheet each.
  EXPECT_NEAR(enclosed_volume(mesh.boundary, nodes.x), before, 2 * 0.5 * 0.05 * 0.005 + 100 * eps);
}

}  // namespace
}  // namespace splashdown::fluid::adapt_test
