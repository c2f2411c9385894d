// Bodies in the grid: added mass, buoyancy, lightness, momentum.
#include <gtest/gtest.h>

#include "bodies_in_grid.hpp"

namespace splashdown::vortex::body_test {
namespace {

using scenes::coupled;
using scenes::FreeBody;
using std::numbers::pi;

/// Acceleration of the first step over that of a body with its added mass, which an exact one would give.
double first_acceleration(FreeBody scene, double added) {
  auto made = coupled(scene);
  const double dt = 1e-3, area = moments_of(scene.outline).area;
  const auto report = made.step(dt);
  EXPECT_EQ(report.passes, 1);
  const double exact = (1 - scene.density) * area * scenes::g / (scene.density * area + added);
  return made.bodies->state(0).velocity[1] / (0.5 * dt) / exact;
}

// Sharp outlines, 48 squares across: within 2 %, and the error falls with h.
TEST(PenalisedBody, first_acceleration_is_that_of_buoyancy_and_added_mass) {
  for (const double density : {1e-3, 0.1, 10., 1e4}) {
    FreeBody circle{.density = density, .h = 1. / 48, .smoothing = 0, .half = 1.5};
    EXPECT_NEAR(first_acceleration(circle, 0.25 * pi), 1, 0.02) << density;
  }
}

// A circle in a channel of breadth W: C_a = 1 + (2 pi^2/3)(R/W)^2 to fourth order.
TEST(PenalisedBody, first_acceleration_feels_the_walls_of_a_channel) {
  constexpr double breadth = 6, added = 1 + 2 * pi * pi / 3 / (4 * breadth * breadth);
  FreeBody circle{
      .density = 1e-3, .h = 1. / 48, .smoothing = 0, .half = breadth / 2, .sides = SideKind::slip, .tall = 3};
  EXPECT_NEAR(first_acceleration(circle, added * 0.25 * pi), 1, 0.02);
}

// Smoothed outlines look no larger: of a light body nothing but added mass resists.
TEST(PenalisedBody, first_acceleration_of_a_smoothed_body_is_good_to_two_per_cent) {
  for (const double density : {1e-3, 0.1, 10., 1e4})
    EXPECT_NEAR(first_acceleration({.density = density, .h = 1. / 48, .half = 1.5}, 0.25 * pi), 1, 0.02) << density;
}

TEST(PenalisedBody, added_mass_of_a_circle_converges_to_what_it_displaces) {
  double last = 1;
  for (const double h : {1. / 12, 1. / 24, 1. / 48}) {
    auto made = coupled({.h = h, .smoothing = 0, .half = 1.5});
    ASSERT_TRUE(made.stepper->attempt(1e-3).ok());
    const std::size_t wall = 0;
    const Eigen::Matrix3d mass = made.fluid->added_mass({&wall, 1});
    const double error = std::abs(mass(1, 1) / (0.25 * pi) - 1);
    EXPECT_LE(error, 1.5 * h);  // half a square around it, and what the lattice counts
    EXPECT_LE(std::abs(mass(0, 1)), 1e-6);
    EXPECT_LT(error, last);
    last = error;
  }
}

// Of an ellipse with semi-axes a and b: rho pi a^2 across a, rho pi b^2 along it, rho pi (a^2 - b^2)^2/8 about its centre (Lamb).
TEST(PenalisedBody, added_masses_of_an_ellipse_are_lambs) {
  constexpr double a = 0.5, b = 0.2;
  auto outline = scenes::circle(1, 200);
  outline.vertices.row(0) *= a;
  outline.vertices.row(1) *= b;
  auto made = coupled({.outline = outline, .h = 1. / 64, .smoothing = 0, .half = 1});
  ASSERT_TRUE(made.stepper->attempt(1e-3).ok());
  const std::size_t wall = 0;
  const Eigen::Matrix3d mass = made.fluid->added_mass({&wall, 1});
  EXPECT_NEAR(mass(0, 0), pi * b * b, 0.06 * pi * b * b);
  EXPECT_NEAR(mass(1, 1), pi * a * a, 0.06 * pi * a * a);
  const double turn = pi * std::pow(a * a - b * b, 2) / 8;
  EXPECT_NEAR(mass(2, 2), turn, 0.1 * turn);
}

/// Speeds stay below those of a body without drag, whatever its density and the step; one pass.
void expect_stable(FreeBody scene, double dt, int steps) {
  auto made = coupled(scene);
  const double area = moments_of(scene.outline).area;
  for (int k = 0; k < steps; ++k) {
    double step = std::min(dt, made.stepper->stable_dt());
    const auto report = made.step(step);
    ASSERT_EQ(report.passes, 1);
    const auto& state = made.bodies->state(0);
    ASSERT_TRUE(state.velocity.allFinite());
    // Energy: (m + M_f) v^2/2 cannot exceed the work of weight and buoyancy on the way, with a margin for the grid's own.
    const double way = state.pose.translation().norm(), work = std::abs(1 - scene.density) * area * scenes::g * way;
    const double free = std::abs(1 - scene.density) / scene.density * scenes::g * (made.stepper->time() + dt);
    ASSERT_LE(state.velocity.head<2>().norm(), free) << made.stepper->time();
    ASSERT_LE(0.5 * scene.density * area * state.velocity.head<2>().squaredNorm(), 1.1 * work + 1e-6)
        << made.stepper->time();
  }
}

TEST(PenalisedBody, is_stable_at_all_densities_in_one_pass) {
  for (const double density : {1e-3, 0.03, 0.5, 2., 10., 1e4})
    for (const double dt : {0.02, 0.002}) expect_stable({.density = density, .h = 1. / 16, .half = 2.5}, dt, 60);
}

TEST(PenalisedBody, is_stable_as_a_light_plate) {
  for (const double smoothing : {0., 0.5})
    for (const double dt : {0.01, 0.001})
      expect_stable({.outline = scenes::box(1, 0.1),
                     .density = 1e-3,
                     .angle = 0.3,
                     .h = 1. / 40,
                     .smoothing = smoothing,
                     .half = 1.2},
                    dt, 40);
}

// Newton's third law with the fluid that fills it: what bodies lose of momentum in still fluid without gravity's help is what vortices
// have gained, int (y, -x) omega = int u, at least as long as nothing leaves the grid.
TEST(PenalisedBody, momentum_of_fluid_and_body_is_that_of_weight) {
  FreeBody scene{.density = 3, .h = 1. / 24, .half = 2.5};
  auto made = coupled(scene);
  const double dt = 0.01, area = moments_of(scene.outline).area;
  double before = 0, weight = 0;
  for (int k = 0; k < 40; ++k) {
    weight += 0.5 * (before + dt) * (1 - scene.density) * area * scenes::g;
    before = dt;
    made.step(dt);
  }
  double impulse = 0;
  const auto& g = made.fluid->spec().grid;
  for (std::size_t k = 0; k < g.nodes(); ++k)
    impulse -= made.fluid->points()[k].x() * made.fluid->vorticity()[k] * g.h * g.h;
  // The vortices' impulse is that of all fluid, with what fills the body.
  const double body = (scene.density - 1) * area * made.bodies->state(0).velocity[1];
  EXPECT_NEAR(body + impulse, weight, 0.01 * std::abs(weight));
}

// A body whose centre of mass is its centroid's neighbour falls alike when it is told by another reference point: it turns at once.
TEST(PenalisedBody, hangs_by_its_centre_of_buoyancy) {
  FreeBody scene{
      .outline = scenes::box(1, 0.4), .density = 0.5, .h = 1. / 32, .smoothing = 0, .half = 1.2, .offset = {0.2, 0}};
  auto made = coupled(scene);
  made.step(1e-3);
  EXPECT_LT(made.bodies->state(0).velocity[2], 0);  // buoyancy on the left of the weight lifts that side
  EXPECT_GT(made.bodies->state(0).velocity[1], 0);
}

TEST(PenalisedBody, that_leaves_the_grid_ends_the_run_with_a_cause) {
  FreeBody scene{.density = 1e4, .h = 1. / 12, .half = 1};
  auto made = coupled(scene);
  std::string cause;
  for (int k = 0; k < 400 && cause.empty(); ++k) {
    const auto report = made.stepper->attempt(std::min(0.01, made.stepper->stable_dt()));
    cause = report.cause;
    if (report.ok()) made.stepper->commit();
  }
  EXPECT_NE(cause.find("leaves the grid"), std::string::npos) << cause;
}

}  // namespace
}  // namespace splashdown::vortex::body_test
