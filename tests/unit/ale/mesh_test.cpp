// The mesh around bodies: what it covers, how it is curved, how it follows walls.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "flows.hpp"
#include "fluid/ale/mesh/extension.hpp"
#include "fluid/ale/mesh/hull_line.hpp"
#include "fluid/ale/mesh/node_count.hpp"

namespace splashdown::ale::mesh_test {
namespace {

using std::numbers::pi;

MeshSpec around(std::vector<Hole> hulls) {
  return {.min = {-1, -1}, .max = {1, 1}, .far = 0.3, .growth = 0.2, .hulls = std::move(hulls)};
}

double area_of(const FlowMesh& mesh) {
  Nodes drift = Nodes::Zero(2, mesh.size());
  drift.row(0).setOnes();
  return 2 * FlowEquations(mesh, 1, 1, {}).kinetic_energy(mesh.nodes, drift);
}

Hole moved_hull(Surface<2> outline, const Isometry<2>& pose, double size) {
  outline.vertices = pose * outline.vertices;
  return {std::move(outline), size};
}

// Twenty edges around a circle as straight ones lack 1.6 % of its area, as quadratic curves some 1e-5.
TEST(FlowMesh, is_curved_around_a_circle) {
  const double radius = 0.4;
  const auto mesh = flow_mesh(around({{scenes::circle(radius, 4000), 2 * pi * radius / 20}}));
  EXPECT_NEAR(area_of(mesh), 4 - pi * radius * radius, 2e-5 * pi * radius * radius);
}

TEST(FlowMesh, keeps_corners_and_covers_all_but_the_bodies) {
  const auto mesh = flow_mesh(around({moved_hull(scenes::box(0.8, 0.1), scenes::at(0.1, -0.2, 0.3), 0.08)}));
  EXPECT_NEAR(area_of(mesh), 4 - 0.08, 1e-12);
}

TEST(FlowMesh, has_a_closed_boundary_with_the_fluid_to_its_left) {
  const auto mesh = flow_mesh(around({{scenes::circle(0.3), 0.1}}));
  std::map<int, int> balance;
  Vec<2> sum = Vec<2>::Zero();
  double area = 0;
  for (const auto& edge : mesh.boundary) {
    ++balance[edge.nodes[0]];
    --balance[edge.nodes[1]];
    EXPECT_NE(edge.wall < 0, edge.side < 0);
    const Vec<2> a = mesh.nodes.col(edge.nodes[0]), b = mesh.nodes.col(edge.nodes[1]);
    sum += b - a;
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  for (const auto& [node, count] : balance) EXPECT_EQ(count, 0);
  EXPECT_NEAR(sum.norm(), 0, 1e-12);
  EXPECT_GT(area, 0);
}

// A cylinder with a flag: one hole, and edges know of which body they are.
TEST(FlowMesh, joins_bodies_that_overlap) {
  const double radius = 0.2;
  const auto mesh = flow_mesh(
      around({{scenes::circle(radius, 2000), 0.05}, moved_hull(scenes::box(0.6, 0.1), scenes::at(0.4, 0), 0.05)}));
  const double root = std::sqrt(radius * radius - 0.05 * 0.05), half = std::asin(0.05 / radius);
  const double flag = (0.7 - root) * 0.1 - radius * radius * (half - std::sin(half) * std::cos(half));
  EXPECT_NEAR(area_of(mesh), 4 - pi * radius * radius - flag, 1e-5);
  for (const auto& edge : mesh.boundary)
    if (edge.wall >= 0) {
      const double away = mesh.nodes.col(edge.nodes[2]).norm();
      EXPECT_EQ(edge.wall, away < radius * (1 + 1e-4) ? 0 : 1) << away;
    }
}

TEST(FlowMesh, is_finer_at_corners_that_jut_out) {
  auto spec = around({{scenes::box(0.8, 0.4), 0.1}});
  const auto coarse = hull_lines(spec.hulls);
  auto line = coarse.front();
  const double size = 0.1;
  line.divide({&size, 1}, spec);
  const auto even = line.cuts().size();
  EXPECT_EQ(even, 24u);
  spec.corner = 0.1;
  line.divide({&size, 1}, spec);
  EXPECT_GT(line.cuts().size(), 2 * even);
  EXPECT_LT(line.cuts()[1] - line.cuts()[0], 0.3 * size);
}

TEST(FlowMesh, refuses_bodies_that_cross_the_box) {
  EXPECT_THROW(flow_mesh(around({moved_hull(scenes::box(0.8, 0.4), scenes::at(0.9, 0), 0.1)})), std::invalid_argument);
}

// Longest edges are as asked, and how much shorter the others are does not depend on hulls, sizes and how they grow.
TEST(FlowMesh, has_as_many_nodes_as_foreseen) {
  std::mt19937 random(4);
  const auto within = [&](double least, double most) { return std::uniform_real_distribution<>(least, most)(random); };
  for (int n = 0; n < 24; ++n) {
    MeshSpec spec{
        .min = {0, 0}, .max = {within(1, 3), within(0.5, 1.5)}, .far = 0, .growth = within(0.1, 0.4), .hulls = {}};
    const double breadth = spec.max.minCoeff(), length = 0.25 * breadth;
    spec.far = within(0.05, 0.2) * breadth;
    spec.corner = std::pow(10, -within(0, 1.3));
    const double size = std::min(within(0.15, 1) * spec.far, 0.3 * length), angle = within(0, 3);
    const Vec<2> centre = 0.5 * spec.max, along = 0.9 * length * Vec<2>(std::cos(angle), std::sin(angle));
    if (n % 4 == 1)
      spec.hulls = {moved_hull(scenes::circle(within(0.3, 1) * length), scenes::at(centre.x(), centre.y()), size)};
    if (n % 4 > 1)
      spec.hulls = {moved_hull(scenes::box(length, 0.3 * length), scenes::at(centre.x(), centre.y(), angle), size)};
    if (n % 4 > 2)  // they overlap: no fluid between them
      spec.hulls.push_back(moved_hull(scenes::box(length, 0.3 * length),
                                      scenes::at(centre.x() + along.x(), centre.y() + along.y(), angle), size));
    const double made = flow_mesh(spec).size();
    EXPECT_NEAR(foreseen_nodes(spec) / made, 1, 0.15) << n << ": " << made;
  }
}

// Where elements are far smaller at a hull than away from it, there are as many as fit along it, over h: also where they are too
// many to be made.
TEST(FlowMesh, foresees_twice_as_many_nodes_with_half_the_size_at_hulls) {
  const auto foreseen = [](double size) { return foreseen_nodes(around({{scenes::circle(0.3), size}})); };
  for (const double size : {1e-3, 2e-4}) EXPECT_NEAR(foreseen(size / 2) / foreseen(size), 2, 0.3) << size;
}

constexpr ExtensionLaw laws[] = {ExtensionLaw::laplace, ExtensionLaw::biharmonic};

/// Moves hulls and says what nodes do.
template <class Move>
Nodes extended(const FlowMesh& mesh, ExtensionLaw law, Move&& move) {
  Nodes d = Nodes::Zero(2, mesh.size());
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes)
      if (edge.wall >= 0) d.col(a) = move(Vec<2>(mesh.nodes.col(a)));
  Extension(mesh, law).extend(d);
  return d;
}

// Linear in its walls: what they do the middle of the way, nodes do too, and rest stays rest.
TEST(Extension, is_linear_and_comes_back) {
  const auto mesh = flow_mesh(around({{scenes::circle(0.3), 0.1}}));
  for (const auto law : laws) {
    const Nodes whole = extended(mesh, law, [](const Vec<2>& x) { return Vec<2>(0.2, -x.x()); });
    const Nodes half = extended(mesh, law, [](const Vec<2>& x) { return Vec<2>(0.1, -0.5 * x.x()); });
    EXPECT_NEAR((whole - 2 * half).norm(), 0, 1e-12 * whole.norm());
    EXPECT_EQ(extended(mesh, law, [](const Vec<2>&) { return Vec<2>(0, 0); }).norm(), 0);
  }
}

// A quarter of the free way to the side: cells of such a stretch are still good ones.
TEST(Extension, keeps_cells_unfolded) {
  const auto mesh = flow_mesh(around({{scenes::box(0.4, 0.1), 0.02}}));
  const FlowEquations equations(mesh, 1, 1, {});
  EXPECT_NEAR(equations.least_stretch(mesh.nodes), 1, 0.6);  // curved cells differ in themselves
  const Mat<2> turn = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  for (const auto law : laws) {
    const Nodes d = extended(mesh, law, [&](const Vec<2>& x) { return Vec<2>(turn * x + Vec<2>(0.1, 0.2) - x); });
    EXPECT_GT(equations.least_stretch(mesh.nodes + d), 0.3);
  }
}

// Between a plate that comes near and a side d follows a cubic without slopes at its ends, whose slope is 3/2 of the mean at most:
// cells keep 1 - 3/2 of the share of the gap that closes. Stiff small cells leave it all to the large ones at the side.
TEST(Extension, biharmonic_spreads_what_closes_a_gap) {
  auto spec = around({{scenes::box(0.8, 0.1), 0.02}});
  spec.far = 0.2;
  const auto mesh = flow_mesh(spec);
  const FlowEquations equations(mesh, 1, 1, {});
  constexpr double gap = 0.95;
  for (const double share : {0.3, 0.4, 0.5}) {
    const auto least = [&](ExtensionLaw law) {
      return equations.least_stretch(mesh.nodes +
                                     extended(mesh, law, [&](const Vec<2>&) { return Vec<2>(0, share * gap); }));
    };
    EXPECT_NEAR(least(ExtensionLaw::biharmonic), 1 - 1.5 * share, 0.01);
    EXPECT_LT(least(ExtensionLaw::laplace), 0.5 * (1 - 1.5 * share));
  }
}

}  // namespace
}  // namespace splashdown::ale::mesh_test
