// Viscosity with the pressure or before it: order in time, and what splitting the two costs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid/effects/viscosity/viscosity.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using std::numbers::pi;

constexpr double side = 1, size = side / 16, density = 1000;
// So slow that nothing moves: what is left of the equations is linear.
constexpr double speed = 1e-6;

/// Water that fills a square box.
scenes::Watched<2> box(const fluid::Formulation<2>& formulation, double viscosity, bool sticks,
                       const std::function<Vec(const Vec&)>& velocity) {
  fluid::FluidSpec<2> spec;
  spec.density = density;
  spec.size = {.surface = size, .far = size};
  spec.step.dt_max = 1e9;
  fluid::WallSpec<2> tank = fluid::scenes::wall(
      "tank", fluid::scenes::turned_inside_out(fluid::scenes::rectangle({0, 0}, {side, side})), size);
  tank.sticks = sticks;
  spec.walls.push_back(tank);
  spec.liquids.push_back({fluid::scenes::rectangle({0, 0}, {side, side}), velocity});
  auto effects = fluid::scenes::no_effects();
  effects.push_back(std::make_unique<fluid::Viscosity<2>>(viscosity));
  return scenes::Watched<2>(std::make_unique<fluid::Fluid<2>>(std::move(spec), std::move(effects), formulation));
}

/// A vortex between walls that slip: it keeps its form and decays with exp(-2 pi^2 nu t).
Vec slipping(const Vec& x) {
  return speed * Vec(-std::sin(pi * x.x()) * std::cos(pi * x.y()), std::cos(pi * x.x()) * std::sin(pi * x.y()));
}
/// A vortex that walls hold.
Vec held(const Vec& x) {
  const double a = std::sin(pi * x.x()), b = std::sin(pi * x.y());
  return speed * Vec(-a * a * std::sin(2 * pi * x.y()), std::sin(2 * pi * x.x()) * b * b);
}

/// Share of the first vortex in the velocity at t, after as many equal steps.
double amplitude(const fluid::Formulation<2>& formulation, double nu, double end, int steps) {
  auto stepper = box(formulation, density * nu, false, slipping);
  const double dt = end / steps;
  for (int k = 0; k < steps; ++k) {
    EXPECT_TRUE(stepper.attempt(dt).ok());
    stepper.commit();
  }
  EXPECT_TRUE(stepper.attempt(dt).ok());
  double with = 0, self = 0;
  const auto& fluid = stepper.fluid();
  for (std::size_t i = 0; i < fluid.nodes().size(); ++i) {
    const Vec first = slipping(fluid.nodes().x[i]);
    with += fluid.velocity_n(i).dot(first), self += first.squaredNorm();
  }
  return with / self;
}

double order(const fluid::Formulation<2>& formulation, double number) {
  const double nu = 1, dt = number * size * size / nu, end = 4 * dt;
  const double a = amplitude(formulation, nu, end, 4), b = amplitude(formulation, nu, end, 8),
               c = amplitude(formulation, nu, end, 16);
  std::printf("%g: %.6f %.6f %.6f exact %.6f\n", number, a, b, c, std::exp(-2 * pi * pi * nu * end));
  return std::log2((a - b) / (b - c));
}

TEST(Viscous, order) {
  for (const double number : {0.01, 0.1, 1.0, 10.0}) {
    std::printf("frac %.3f\n", order(fluid::fractional<2>(), number));
    std::printf("mono %.3f\n", order(fluid::monolithic<2>({}), number));
    std::printf("euler %.3f\n", order(fluid::monolithic<2>({.implicit_euler = true}), number));
  }
}

/// Largest difference of velocities after a step, over the speed.
double split(double number, bool sticks) {
  const double nu = 1, dt = 2 * number * size * size / nu;  // the first kick is half a step
  auto a = box(fluid::fractional<2>(), density * nu, sticks, held),
       b = box(fluid::monolithic<2>({.implicit_euler = true}), density * nu, sticks, held);
  EXPECT_TRUE(a.attempt(dt).ok());
  EXPECT_TRUE(b.attempt(dt).ok());
  double most = 0, sum = 0, of = 0;
  for (std::size_t i = 0; i < a.fluid().nodes().size(); ++i) {
    const double e = (a.fluid().result().velocity[i] - b.fluid().result().velocity[i]).norm();
    most = std::max(most, e), sum += e * e, of += held(a.fluid().nodes().x[i]).squaredNorm();
  }
  std::printf("split %g: max %.3e rms %.3e\n", number, most / speed, std::sqrt(sum / of));
  return most / speed;
}

TEST(Viscous, split) {
  for (const double number : {1e-6, 0.001, 0.0032, 0.01, 0.032, 0.1, 0.32, 1.0, 3.2, 10.0}) split(number, true);
}

}  // namespace
}  // namespace splashdown
