#include "coupling/interface_term.hpp"

#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::coupling::interface_term_test {
namespace {

using scenes::eps;

WallCoordinates wall(double mass, bool answers = true) {
  return {.name = "wall", .first = 0, .count = 3, .answers = answers, .mass = mass, .volume = 1};
}

TEST(InterfaceTerms, have_the_names_a_scene_gives_them) {
  EXPECT_EQ(NoTerm().name(), "none");
  EXPECT_EQ(LaplacianTerm().name(), "laplacian");
  EXPECT_EQ(RobinTerm().name(), "robin");
}

TEST(InterfaceTerms, of_a_wall_that_does_not_answer_are_absent) {
  EXPECT_EQ(LaplacianTerm().interface_operator(wall(300, false)).laplacian, 0);
  EXPECT_EQ(RobinTerm().interface_operator(wall(300, false)).robin, 0);
  EXPECT_EQ(NoTerm().interface_operator(wall(300)).laplacian, 0);
  EXPECT_EQ(RobinTerm().interface_operator(wall(0, false)).robin, 0) << "nor does it need a mass";
}

TEST(RobinTerm, goes_like_one_over_mass) {
  const double at_300 = RobinTerm().interface_operator(wall(300)).robin;
  EXPECT_NEAR(RobinTerm().interface_operator(wall(30)).robin, 10 * at_300, 100 * eps * at_300);
}

TEST(LaplacianTerm, goes_like_strength_over_mass) {
  const double at_300 = LaplacianTerm().interface_operator(wall(300)).laplacian;
  EXPECT_NEAR(LaplacianTerm().interface_operator(wall(30)).laplacian, 10 * at_300, 100 * eps * at_300);
  EXPECT_NEAR(LaplacianTerm(2).interface_operator(wall(300)).laplacian, 2 * at_300, 10 * eps * at_300);
}

// Energies of a translation's pressure, phi ~ n, under a stand-in and under the exact term. A ring of water
// around a circle: the hull's nodes lie on it at equal steps.
double mismatch(const InterfaceTerm& term, int segments) {
  constexpr double mass = 100;
  scenes::Scene scene;
  const double h = 2 * std::numbers::pi * 0.5 / segments;
  scene.fluid.size = {.surface = h, .far = h};
  scene.fluid.liquids.push_back({fluid::scenes::ellipse(1, 1, 256), {}});
  scene.add_body(rigid::circle(0.5, segments), mass, {0, 0}, h);
  const fluid::scenes::Placed placed(scene.fluid);
  const auto water = fluid::fill<2>(scene.fluid, placed.at());
  const std::vector<fluid::WallPlace<2>> places(1);
  const InterfaceOperator of_wall = term.interface_operator(wall(mass));
  const InterfaceModel response{.interface_operators = {of_wall}};
  fluid::PressureEquation<2> equation;
  EXPECT_TRUE(equation.build(water.nodes, water.mesh, scenes::water, places, fluid::WallLayout<2>::rigid(1), response));
  double interface_operator = 0, exact = 0;
  for (int axis : {0, 1}) {
    std::vector<double> phi(equation.size(), 0.0), flux(equation.size(), 0.0);
    for (std::size_t i = 0; i < water.nodes.size(); ++i)
      if (water.nodes.tie[i].wall == 0) phi[equation.unknown()[i]] = water.nodes.x[i].normalized()[axis];
    equation.laplacian().add(equation.laplacian().means(phi), flux);
    for (std::size_t i = 0; i < phi.size(); ++i) interface_operator += phi[i] * flux[i];
    const auto impulse = equation.impulse(0, phi);
    exact += impulse.rigid.head<2>().squaredNorm() / mass;
  }
  return std::abs(interface_operator / exact - 1);
}

TEST(InterfaceTerms, that_stand_in_give_translations_of_a_circle_their_energy) {
  // Exact for the facets' normals; the mean of an edge's nodal normals is shorter by 1 - cos(pi / n), and the pieces'
  // means of both differ by as much again: (pi / n)^2 in all.
  for (int n : {16, 32, 64}) {
    EXPECT_LE(mismatch(LaplacianTerm(), n), std::pow(std::numbers::pi / n, 2)) << n;
    EXPECT_LE(mismatch(RobinTerm(), n), std::pow(std::numbers::pi / n, 2)) << n;
  }
}

}  // namespace
}  // namespace splashdown::coupling::interface_term_test
