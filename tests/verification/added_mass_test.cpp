// A circle of radius a in a ring of liquid of outer radius b, p = 0 there:
//   p = - rho A a^2 / (a^2 + b^2) (r - b^2 / r) cos(theta),   M_a = rho pi a^2 (b^2 - a^2) / (b^2 + a^2)
// The discrete added mass is an energy of linear elements: second order in h, nodes being on the circles.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"
#include "tests/verification/order.hpp"

namespace splashdown::added_mass_test {
namespace {

using coupling::scenes::water;

constexpr double a = 0.5, b = 1.5;

coupling::scenes::Scene ring(double h) {
  coupling::scenes::Scene scene;
  scene.gravity.setZero();
  scene.fluid.size = {.surface = h, .far = h};
  scene.fluid.liquids.push_back({fluid::scenes::ellipse(b, b, 512), {}});
  scene.add_body(rigid::circle(a, 512), 100, {0, 0}, h);
  return scene;
}

// From the response of the coupled equation to a body that would have moved with velocity s.
double added_mass(double h, double mass, int axis) {
  fluid::Fluid<2> f(ring(h).fluid, fluid::scenes::no_effects());
  const InterfaceModel response{.modal = {fluid::Twist<2>::Unit(axis), Eigen::MatrixXd::Constant(1, 1, mass)}};
  fluid::Twist<2> s = fluid::Twist<2>::Zero();
  s[axis] = 1;
  const double instant = 1e-6;  // next to nothing moves; positions' roundoff over it is 1e-10 m/s
  EXPECT_TRUE(f.begin(instant, instant, response).ok());
  EXPECT_TRUE(f.solve(std::vector{s}).status.ok());
  return mass * (1 / f.result().wall_velocities[0].rigid[axis] - 1);
}

const double exact = water * std::numbers::pi * a * a * (b * b - a * a) / (b * b + a * a);

// What linear elements find without the corrections: a subspace of the flows, hence less energy than the exact one.
double error_without_corrections(double h) {
  const std::array<std::size_t, 1> circle{0};
  fluid::Fluid<2> f(ring(h).fluid, fluid::scenes::no_effects());
  EXPECT_TRUE(f.begin(1e-3, 1e-3, {}).ok());
  return 1 + f.interface_slope(circle)(1, 1) / exact;
}

TEST(AddedMass, of_a_circle_is_met_better_than_with_second_order) {
  const std::array h{0.2, 0.1, 0.05, 0.025};
  std::array<double, 4> bound;
  for (std::size_t i = 0; i < h.size(); ++i) {
    bound[i] = error_without_corrections(h[i]);
    EXPECT_GT(bound[i], 0);
    EXPECT_LE(std::abs(added_mass(h[i], 100, 1) / exact - 1), bound[i]) << h[i];
  }
  EXPECT_GE(order_of(h, bound), 2 - 0.2) << bound[0] << ' ' << bound[1] << ' ' << bound[2] << ' ' << bound[3];
}

TEST(AddedMass, as_a_matrix_is_what_the_step_answers_with) {
  // Both take the same corrections; what is left is that the step moves.
  const std::array<std::size_t, 1> circle{0};
  for (double h : {0.2, 0.1, 0.05}) {
    fluid::Fluid<2> f(ring(h).fluid, fluid::scenes::no_effects());
    EXPECT_THROW(f.added_mass(circle), std::logic_error) << "no pressure equation yet";
    ASSERT_TRUE(f.begin(1e-3, 1e-3, {}).ok());
    const Eigen::Matrix3d G = f.added_mass(circle);
    EXPECT_NEAR(G(1, 1), added_mass(h, 100, 1), 1e-3 * exact);
    EXPECT_NEAR(G(0, 0), G(1, 1), 0.04 * exact);
    EXPECT_LE((G - G.transpose()).norm(), 1e-10 * G.norm());
  }
}

TEST(AddedMass, of_a_star_is_what_the_step_answers_with) {
  // Its hollow corners hold water that moves with it. s_after = (M + G)^-1 M s.
  constexpr double h = 0.1, mass = 10;
  coupling::scenes::Scene scene = ring(h);
  scene.fluid.walls.front() = fluid::scenes::wall("star", fluid::scenes::star(5, a, 0.5 * a), h);
  const Eigen::Matrix3d M = mass * Eigen::Matrix3d::Identity();
  fluid::Fluid<2> f(scene.fluid, fluid::scenes::no_effects());
  const std::array<std::size_t, 1> star{0};
  const Eigen::Vector3d s(0.3, 1, -0.5);
  ASSERT_TRUE(f.begin(1e-6, 1e-6, {Eigen::Matrix3d::Identity(), M, {}}).ok());
  const Eigen::Matrix3d G = f.added_mass(star);
  ASSERT_TRUE(f.solve(std::vector<fluid::Twist<2>>{s}).status.ok());
  const Eigen::Vector3d after = f.result().wall_velocities[0].rigid, expected = (M + G).ldlt().solve(M * s);
  EXPECT_LE((after - expected).norm(), 1e-3 * expected.norm());
}

TEST(AddedMass, does_not_depend_on_the_body_that_feels_it) {
  const double reference = added_mass(0.1, 1000, 0);
  // The corrections are cut off, and what they leave depends on what the body does: a hundredth of the error of
  // the mesh itself.
  for (double mass : {1e5, 10.0, 1e-1})
    EXPECT_NEAR(added_mass(0.1, mass, 0), reference, 0.01 * std::abs(reference - exact)) << mass;
}

TEST(AddedMass, of_a_circle_is_the_same_in_heave_and_sway_and_none_in_roll) {
  // To the error of the mesh, second order: (h / a)^2 = 0.04 of a circle's own.
  EXPECT_NEAR(added_mass(0.1, 100, 0), added_mass(0.1, 100, 1), 0.04 * exact);
  const double inertia = 100 * a * a / 2;
  EXPECT_LE(std::abs(added_mass(0.1, inertia, 2)), 0.01 * exact * a * a) << "the polygon's corners stir a little";
}

TEST(AddedMass, in_a_tank_tends_to_that_in_open_water) {
  // Blockage ~ (a / b)^2: M_a / (rho pi a^2) = (b^2 - a^2) / (b^2 + a^2) -> 1. Here a square tank's free
  // surface.
  std::array<double, 3> half{1.5, 3.0, 6.0}, error;
  for (std::size_t i = 0; i < half.size(); ++i) {
    coupling::scenes::Scene scene;
    const double L = half[i];
    scene.fluid.size = {.surface = 0.1 * L, .far = 0.1 * L, .growth = 0.1};
    scene.fluid.liquids.push_back({fluid::scenes::rectangle({-L, -L}, {L, L}), {}});
    scene.add_body(rigid::circle(a, 256), 100, {0, 0}, 0.025);
    fluid::Fluid<2> f(scene.fluid, fluid::scenes::no_effects());
    const InterfaceModel response{.modal = {Eigen::MatrixXd::Identity(3, 2), 100 * Eigen::Matrix2d::Identity()}};
    ASSERT_TRUE(f.begin(1e-6, 1e-6, response).ok());
    ASSERT_TRUE(f.solve(std::vector{fluid::Twist<2>(0, 1, 0)}).status.ok());
    const double M = 100 * (1 / f.result().wall_velocities[0].rigid[1] - 1);
    error[i] = M / (water * std::numbers::pi * a * a) - 1;
  }
  EXPECT_GE(-order_of(half, error), 1) << error[0] << ' ' << error[1] << ' ' << error[2];
  EXPECT_LE(std::abs(error[2]), 0.02);
}

}  // namespace
}  // namespace splashdown::added_mass_test
