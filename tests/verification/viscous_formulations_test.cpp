// Viscosity with the pressure or before it: order in time, and what splitting the two costs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid/effects/viscosity/viscosity.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::viscous_formulations_test {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using std::numbers::pi;

constexpr double density = 1000, nu = 1;
// So slow that nothing moves: what is left of the equations is linear.
constexpr double speed = 1e-6;

std::vector<std::unique_ptr<fluid::Effect<2>>> viscous() {
  auto effects = fluid::scenes::no_effects();
  effects.push_back(std::make_unique<fluid::Viscosity<2>>(density * nu));
  return effects;
}

fluid::FluidSpec<2> square(double size) {
  fluid::FluidSpec<2> spec;
  spec.density = density;
  spec.size = {.surface = size, .far = size};
  spec.step.dt_max = 1e9;
  spec.liquids.push_back({fluid::scenes::rectangle({0, 0}, {1, 1}), {}});
  return spec;
}

/// A vortex between walls that slip: it keeps its form and decays with exp(-2 pi^2 nu t).
Vec vortex(const Vec& x) {
  return speed * Vec(-std::sin(pi * x.x()) * std::cos(pi * x.y()), std::cos(pi * x.x()) * std::sin(pi * x.y()));
}

/// Share of the first vortex in the velocity at t, after as many equal steps.
double amplitude(const fluid::Formulation<2>& formulation, double size, double end, int steps) {
  auto spec = square(size);
  spec.liquids[0].velocity = vortex;
  spec.walls.push_back(
      fluid::scenes::wall("box", fluid::scenes::turned_inside_out(fluid::scenes::rectangle({0, 0}, {1, 1})), size));
  scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(std::move(spec), viscous(), formulation));
  for (int k = 0; k <= steps; ++k) {
    if (k > 0) stepper.commit();
    EXPECT_TRUE(stepper.attempt(end / steps).ok());
  }
  double with = 0, self = 0;
  for (std::size_t i = 0; i < stepper.fluid().nodes().size(); ++i) {
    const Vec first = vortex(stepper.fluid().nodes().x[i]);
    with += stepper.fluid().velocity_n(i).dot(first), self += first.squaredNorm();
  }
  return with / self;
}

/// Observed, from four, eight and sixteen steps, the first with nu dt / h^2 = `number`.
double order(const fluid::Formulation<2>& formulation, double number) {
  const double size = 1.0 / 16, end = 4 * number * size * size / nu;
  const double coarse = amplitude(formulation, size, end, 4), middle = amplitude(formulation, size, end, 8);
  return std::log2((coarse - middle) / (middle - amplitude(formulation, size, end, 16)));
}

// Below 1 the differences are those of the tolerance: rates of decay times dt are 1e-3 there.
TEST(ViscousFormulations, monolithic_is_of_second_order_in_time_the_others_of_first) {
  for (const double number : {1.0, 10.0}) {
    EXPECT_NEAR(order(fluid::monolithic<2>(), number), 2, 0.3);
    EXPECT_NEAR(order(fluid::monolithic<2>({.implicit_euler = true}), number), 1, 0.1);
    EXPECT_NEAR(order(fluid::fractional<2>(), number), 1, 0.1);
  }
  EXPECT_NEAR(amplitude(fluid::monolithic<2>(), 1.0 / 16, 0.04 / 256, 4), std::exp(-2 * pi * pi * 0.04 / 256), 1e-3);
}

/// A cavity under a lid that is drawn over it, all walls sticking.
scenes::Watched<2> cavity(const fluid::Formulation<2>& formulation, double size) {
  scenes::Scene scene;
  scene.gravity.setZero();
  scene.fluid = square(size);
  scene.fluid.walls.push_back(fluid::scenes::wall(
      "tank", fluid::scenes::outline({{-.5, -.5}, {1.5, -.5}, {1.5, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {-.5, 1}}),
      size));
  scene.add_body(rigid::box(3, 0.5), 1, {0.5, 1.25}, size);
  scene.bodies[0].free = {false, false, false};
  scene.set_velocity(0, {speed, 0, 0});
  for (auto& wall : scene.fluid.walls) wall.sticks = true;
  return scenes::Watched<2>(std::make_unique<fluid::Fluid<2>>(scene.fluid, viscous(), formulation),
                            scenes::bodies_of(scene));
}

struct Split {
  double apart = 0;                        ///< largest difference of velocities, over the lid's
  double drag_split = 0, drag_as_one = 0;  ///< of the lid, over mu U
};
Split split(double number, double size) {
  auto first = cavity(fluid::fractional<2>(), size), as_one = cavity(fluid::monolithic<2>(), size);
  const double dt = number * size * size / nu;
  const int steps = std::max(4, static_cast<int>(8 / number));
  for (int k = 0; k < steps; ++k) {
    if (k > 0) first.commit(), as_one.commit();
    EXPECT_TRUE(first.attempt(dt).ok() && as_one.attempt(dt).ok());
  }
  Split found;
  const auto &a = first.fluid().result(), &b = as_one.fluid().result();
  for (std::size_t i = 0; i < a.velocity.size(); ++i)
    found.apart = std::max(found.apart, (a.velocity[i] - b.velocity[i]).norm() / speed);
  found.drag_split = -a.loads[0].total()[0] / (density * nu * speed);
  found.drag_as_one = -b.loads[0].total()[0] / (density * nu * speed);
  return found;
}

// What the pressure changes in a kick no viscosity has seen: at the corners of the lid grad p is mu U / h^2, and the water
// there is wrong by about 0.8 nu dt / h^2 of U, until it is as wrong as it can be. The lid's drag loses as much.
TEST(ViscousFormulations, splitting_viscosity_from_pressure_costs_its_number_and_monolithic_nothing) {
  const double size = 1.0 / 8;
  for (const double number : {0.05, 0.1, 0.2}) {
    const auto found = split(number, size);
    EXPECT_GT(found.apart, 0.5 * 0.8 * number);
    EXPECT_LT(found.apart, 2 * 0.8 * number);
  }
  const auto small = split(0.1, size), large = split(1, size);
  EXPECT_LT(small.drag_split, 0.95 * small.drag_as_one);
  EXPECT_LT(large.drag_split, 0.85 * large.drag_as_one);
  EXPECT_NEAR(large.drag_as_one, small.drag_as_one, 0.06 * small.drag_as_one);
}

// A light circle in thick water that sticks to it: Newton's law holds for the sum of pressure and stress.
TEST(ViscousFormulations, light_bodies_answer_pressure_and_stress_at_once) {
  auto scene = scenes::submerged_circle(1e-3, 0.2);
  for (auto& wall : scene.fluid.walls) wall.sticks = true;
  auto effects = fluid::scenes::gravity(scene.gravity);
  effects.push_back(std::make_unique<fluid::Viscosity<2>>(density * 10));
  scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(scene.fluid, std::move(effects), fluid::monolithic<2>()),
                             scenes::bodies_of(scene));
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(stepper.attempt(2e-3).ok());
    const auto& found = stepper.fluid().result();
    // What Newton's law leaves of the velocity that buoyancy gives it.
    EXPECT_LT(found.imbalance[0].rigid.head<2>().norm(), 1e-3 * 9.81 * (k > 0 ? 2e-3 : 1e-3));
    stepper.commit();
  }
}

}  // namespace
}  // namespace splashdown::viscous_formulations_test
