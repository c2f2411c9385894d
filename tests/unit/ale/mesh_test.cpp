// The mesh around bodies: what it covers, how it is curved, how it follows walls.
#include <gtest/gtest.h>

#include <map>

#include "flows.hpp"
#include "fluid/ale/mesh/extension.hpp"
#include "fluid/ale/mesh/hull_line.hpp"

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

// Linear in its walls: what they do the middle of the way, nodes do too, and rest stays rest.
TEST(Extension, is_linear_and_comes_back) {
  const auto mesh = flow_mesh(around({{scenes::circle(0.3), 0.1}}));
  const Extension extension(mesh);
  Nodes whole = Nodes::Zero(2, mesh.size()), half = whole;
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes)
      if (edge.wall >= 0) {
        whole.col(a) = Vec<2>(0.2, -mesh.nodes(0, a));
        half.col(a) = 0.5 * whole.col(a);
      }
  extension.extend(whole);
  extension.extend(half);
  EXPECT_NEAR((whole - 2 * half).norm(), 0, 1e-12 * whole.norm());
  Nodes none = Nodes::Zero(2, mesh.size());
  extension.extend(none);
  EXPECT_EQ(none.norm(), 0);
}

// A quarter of the free way to the side: cells of such a stretch are still good ones.
TEST(Extension, keeps_cells_unfolded) {
  const auto mesh = flow_mesh(around({{scenes::box(0.4, 0.1), 0.02}}));
  const Extension extension(mesh);
  const FlowEquations equations(mesh, 1, 1, {});
  EXPECT_NEAR(equations.least_stretch(mesh.nodes), 1, 0.6);  // curved cells differ in themselves
  Nodes d = Nodes::Zero(2, mesh.size());
  const Mat<2> turn = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes)
      if (edge.wall >= 0) d.col(a) = turn * mesh.nodes.col(a) + Vec<2>(0.1, 0.2) - mesh.nodes.col(a);
  extension.extend(d);
  EXPECT_GT(equations.least_stretch(mesh.nodes + d), 0.3);
}

}  // namespace
}  // namespace splashdown::ale::mesh_test
