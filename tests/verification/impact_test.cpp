// Impulses: a flat plate on still water, V+ = m V- / (m + M_a), M_a = rho pi c^2 / 2 on deep, wide water.
// The pressure is singular like sqrt at the edges: the energy, hence M_a, is first order in h.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"
#include "tests/verification/order.hpp"

namespace splashdown::impact_test {
namespace {

using coupling::scenes::water;

constexpr double c = 0.5;
const double open_water = water * std::numbers::pi * c * c / 2;

struct Impact {
  double velocity;  // after the step, before: -1
  double impulse;   // on the plate
};

Impact impact(double mass, double size, double dt, double growth = 0.1) {
  const double half_tank = 15;
  coupling::scenes::Scene scene;
  scene.gravity.setZero();
  scene.fluid.size = {.surface = 10 * growth, .far = 15 * growth, .growth = growth};
  scene.fluid.liquids.push_back({fluid::scenes::rectangle({-half_tank, -half_tank}, {half_tank, 0}), {}});
  scene.fluid.walls.push_back(fluid::scenes::wall(
      "tank", fluid::scenes::turned_inside_out(fluid::scenes::rectangle({-half_tank, -half_tank}, {half_tank, 1})), 1));
  scene.add_body(rigid::box(2 * c, 0.1), mass, {0, 0.05}, size);
  scene.bodies[0].free = {false, true, false};
  scene.set_velocity(0, {0, -1, 0});
  const auto stepper = coupling::scenes::coupled(scene);
  const auto report = stepper->attempt(dt);
  EXPECT_TRUE(report.ok()) << report.cause;
  EXPECT_LE(report.passes, 2);
  const double kick = 0.5 * dt;
  return {stepper->trial()[0].velocity[1], kick * stepper->fluid().result().loads[0].total()[1]};
}

double added_mass_of(const Impact& i, double mass) { return mass * (-1 / i.velocity - 1); }

TEST(FlatPlate, converges_to_the_impulse_of_open_water) {
  // A tank thirty half widths to each side: blockage (pi^2 / 24) (c / L)^2 ~ 5e-4 of M_a. The size field is refined as a
  // whole: with a constant growth, h over the distance from the edge would stay. Where the edge's elements lie moves the
  // error of a mesh by a quarter, so that a line through those of several says what a size is worth.
  const std::array size{0.01, 0.009, 0.008, 0.007, 0.006, 0.005, 0.0045, 0.004};
  std::array<double, size.size()> error;
  for (std::size_t i = 0; i < size.size(); ++i)
    error[i] = added_mass_of(impact(open_water, size[i], 1e-5, 10 * size[i]), open_water) / open_water - 1;
  const double order = order_of(size, error);
  EXPECT_GE(order, 1 - 0.2) << testing::PrintToString(error);
  double at_hundred_elements = 0;  // in c
  for (std::size_t i = 0; i < size.size(); ++i)
    at_hundred_elements += std::abs(error[i]) * std::pow(c / 100 / size[i], order) / size.size();
  EXPECT_LE(at_hundred_elements, 0.01) << testing::PrintToString(error);
}

TEST(FlatPlate, velocity_jumps_as_the_masses_say) {
  for (double ratio : {0.1, 1.0, 10.0})
    EXPECT_NEAR(-impact(ratio * open_water, 0.003, 1e-5).velocity, ratio / (ratio + 1), 0.01 * ratio / (ratio + 1))
        << ratio;
}

TEST(FlatPlate, impulse_does_not_depend_on_the_step) {
  const double reference = impact(open_water, 0.02, 1e-5).impulse;
  for (double dt : {8e-5, 1e-4 / 80, 1e-9})
    EXPECT_NEAR(impact(open_water, 0.02, dt).impulse, reference, 0.01 * reference) << dt;
}

TEST(FlatPlate, momentum_lost_is_the_impulse) {
  const Impact i = impact(open_water, 0.02, 1e-5);
  EXPECT_NEAR(open_water * (i.velocity + 1), i.impulse, 1e-8 * i.impulse);
}

TEST(FlatPlate, energy_lost_is_what_an_inelastic_impact_loses) {
  // 1/2 m V-^2 = 1/2 (m + M_a) V+^2 + the loss, which the jet takes: V+ = m V- / (m + M_a). Fluid: 1/2 M_a
  // V+^2.
  coupling::scenes::Scene scene;
  scene.gravity.setZero();
  scene.fluid = fluid::scenes::still_water(8, 4, 0.3);
  scene.fluid.size = {.surface = 0.1, .far = 0.3};
  scene.add_body(rigid::box(2 * c, 0.1), open_water, {0, 0.05}, 0.02);
  scene.bodies[0].free = {false, true, false};
  scene.set_velocity(0, {0, -1, 0});
  const auto stepper = coupling::scenes::coupled(scene);
  ASSERT_TRUE(stepper->attempt(1e-7).ok());
  stepper->commit();
  const auto& f = stepper->fluid();
  std::vector<double> mass(f.nodes().size(), 0.0);
  for (const auto& cell : f.mesh().cells)
    for (int n : cell) mass[n] += water * fluid::volume<2>(fluid::corners(f.nodes().x, cell)) / 3;
  double energy = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) energy += 0.5 * mass[i] * f.nodes().v[i].squaredNorm();
  const double V = stepper->bodies().state(0).velocity[1];
  const double M_a = open_water * (-1 / V - 1);
  // The lumped mass makes P1/P1 projections approximate: a few per cent of the energy sit at the edges.
  EXPECT_NEAR(energy, 0.5 * M_a * V * V, 0.05 * energy);
}

}  // namespace
}  // namespace splashdown::impact_test
