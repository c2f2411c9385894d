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
  EXPECT_EQ(RigidTerm<2>().name(), "rigid");
  EXPECT_EQ(LaplacianTerm<2>().name(), "laplacian");
}

TEST(InterfaceTerms, of_a_fixed_body_are_absent) {
  const auto bodies = two_circles(300);
  EXPECT_EQ(LaplacianTerm<2>().response(bodies, 1).laplacian, 0);
  EXPECT_TRUE(RigidTerm<2>().response(bodies, 1).rigid.isZero(0));
  EXPECT_TRUE(NoTerm<2>().response(bodies, 0).rigid.isZero(0));
  EXPECT_EQ(NoTerm<2>().response(bodies, 0).laplacian, 0);
}

TEST(RigidTerm, is_the_inverse_of_mass_and_inertia) {
  const auto bodies = two_circles(300);
  const auto C = RigidTerm<2>().response(bodies, 0).rigid;
  EXPECT_NEAR(C(0, 0), 1 / 300., eps);
  EXPECT_NEAR(C(1, 1), 1 / 300., eps);
  EXPECT_NEAR(C(2, 2), 1 / bodies.spec(0).inertia(0, 0), eps);
  EXPECT_EQ(C(0, 1), 0);
}

TEST(LaplacianTerm, weight_goes_like_strength_over_mass) {
  const double at_300 = LaplacianTerm<2>().response(two_circles(300), 0).laplacian;
  EXPECT_NEAR(LaplacianTerm<2>().response(two_circles(30), 0).laplacian, 10 * at_300, 100 * eps * at_300);
  EXPECT_NEAR(LaplacianTerm<2>(2).response(two_circles(300), 0).laplacian, 2 * at_300, 10 * eps * at_300);
}

// A ring of water around a circle: the hull's nodes lie on the circle at equal steps.
double mismatch(int segments) {
  scenes::Scene scene;
  const double h = 2 * std::numbers::pi * 0.5 / segments;
  scene.fluid.size = {.surface = h, .far = h};
  scene.fluid.liquids.push_back({fluid::scenes::ellipse(1, 1, 256), {}});
  scene.add_body(rigid::circle(0.5, segments), 100, {0, 0}, h);
  const rigid::Bodies<2> bodies(scene.bodies, {});
  const fluid::scenes::Placed placed(scene.fluid);
  const auto water = fluid::fill<2>(scene.fluid, placed.at());
  const std::vector<fluid::Vec<2>> centre{{0, 0}};
  std::vector<fluid::WallResponse<2>> response{LaplacianTerm<2>().response(bodies, 0)};
  fluid::PressureEquation<2> equation;
  EXPECT_TRUE(equation.build(water.nodes, water.mesh, scenes::water, centre, response));
  std::vector<double> phi(equation.size(), 0.0), laplacian(equation.size(), 0.0), flux;
  for (std::size_t i = 0; i < water.nodes.size(); ++i)
    if (water.nodes.tie[i].wall == 0) phi[equation.unknown()[i]] = water.nodes.x[i].normalized().y();
  equation.add_laplacian(phi, laplacian);
  const fluid::Twist<2> answer = bodies.compliance(0) * equation.impulse(0, phi);
  const std::vector<fluid::Vec<2>> still(water.nodes.size(), fluid::Vec<2>::Zero());
  equation.flux_residual(water.nodes.x, still, std::vector{answer}, centre, flux);  // - B^T C B phi
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < flux.size(); ++i)
    difference += std::pow(laplacian[i] + flux[i], 2), size += flux[i] * flux[i];
  return std::sqrt(difference / size);
}

TEST(LaplacianTerm, is_the_rigid_term_for_a_circle_in_heave_to_second_order) {
  const double coarse = mismatch(16), fine = mismatch(32), finest = mismatch(64);
  EXPECT_GE(std::log2(coarse / fine), 2 - 0.2);
  EXPECT_GE(std::log2(fine / finest), 2 - 0.2);
  EXPECT_LT(finest, 0.01);
}

}  // namespace
}  // namespace splashdown::coupling
