#include "coupling/interface_term.hpp"

#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::coupling {
namespace {

using scenes::eps;

rigid::Bodies<2> two_circles(double mass) {
  auto scene = scenes::submerged_circle(1);
  scene.bodies[0].mass = mass;
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].name = "fixed";
  scene.bodies[1].motion = rigid::Motion::fixed;
  return {scene.bodies, {}};
}

TEST(InterfaceTerms, have_the_names_a_scene_gives_them) {
  EXPECT_EQ(NoTerm<2>().name(), "none");
  EXPECT_EQ(LaplacianTerm<2>().name(), "laplacian");
  EXPECT_EQ(RobinTerm<2>().name(), "robin");
}

TEST(InterfaceTerms, of_a_fixed_body_are_absent) {
  const auto bodies = two_circles(300);
  EXPECT_EQ(LaplacianTerm<2>().stand_in(bodies, 1).laplacian, 0);
  EXPECT_EQ(RobinTerm<2>().stand_in(bodies, 1).robin, 0);
  EXPECT_EQ(NoTerm<2>().stand_in(bodies, 0).laplacian, 0);
}

TEST(RobinTerm, goes_like_one_over_mass) {
  const double at_300 = RobinTerm<2>().stand_in(two_circles(300), 0).robin;
  EXPECT_NEAR(RobinTerm<2>().stand_in(two_circles(30), 0).robin, 10 * at_300, 100 * eps * at_300);
}

TEST(LaplacianTerm, goes_like_strength_over_mass) {
  const double at_300 = LaplacianTerm<2>().stand_in(two_circles(300), 0).laplacian;
  EXPECT_NEAR(LaplacianTerm<2>().stand_in(two_circles(30), 0).laplacian, 10 * at_300, 100 * eps * at_300);
  EXPECT_NEAR(LaplacianTerm<2>(2).stand_in(two_circles(300), 0).laplacian, 2 * at_300, 10 * eps * at_300);
}

// Energies of a translation's pressure, phi ~ n, under a stand-in and under the exact term. A ring of water
// around a circle: the hull's nodes lie on it at equal steps.
double mismatch(const InterfaceTerm<2>& term, int segments) {
  scenes::Scene scene;
  const double h = 2 * std::numbers::pi * 0.5 / segments;
  scene.fluid.size = {.surface = h, .far = h};
  scene.fluid.liquids.push_back({fluid::scenes::ellipse(1, 1, 256), {}});
  scene.add_body(rigid::circle(0.5, segments), 100, {0, 0}, h);
  const rigid::Bodies<2> bodies(scene.bodies, {});
  const fluid::scenes::Placed placed(scene.fluid);
  const auto water = fluid::fill<2>(scene.fluid, placed.at());
  const std::vector<fluid::Vec<2>> centre{{0, 0}};
  const fluid::WallResponse<2> response{{}, {}, {term.stand_in(bodies, 0)}};
  fluid::PressureEquation<2> equation;
  EXPECT_TRUE(equation.build(water.nodes, water.mesh, scenes::water, centre, response));
  double stand_in = 0, exact = 0;
  for (int axis : {0, 1}) {
    std::vector<double> phi(equation.size(), 0.0), flux(equation.size(), 0.0);
    for (std::size_t i = 0; i < water.nodes.size(); ++i)
      if (water.nodes.tie[i].wall == 0) phi[equation.unknown()[i]] = water.nodes.x[i].normalized()[axis];
    equation.laplacian().add(equation.laplacian().means(phi), flux);
    for (std::size_t i = 0; i < phi.size(); ++i) stand_in += phi[i] * flux[i];
    const auto impulse = equation.impulse(0, phi);
    exact += impulse.head<2>().squaredNorm() / bodies.spec(0).mass;
  }
  return std::abs(stand_in / exact - 1);
}

TEST(InterfaceTerms, that_stand_in_give_translations_of_a_circle_their_energy) {
  // Exact for the facets' normals; the mean of an edge's nodal normals is shorter by 1 - cos(pi / n), and the pieces'
  // means of both differ by as much again: (pi / n)^2 in all.
  for (int n : {16, 32, 64}) {
    EXPECT_LE(mismatch(LaplacianTerm<2>(), n), std::pow(std::numbers::pi / n, 2)) << n;
    EXPECT_LE(mismatch(RobinTerm<2>(), n), std::pow(std::numbers::pi / n, 2)) << n;
  }
}

}  // namespace
}  // namespace splashdown::coupling
