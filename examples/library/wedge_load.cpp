// Drops a wedge on water and prints its load: the library without scenes and files. 2D: all values per metre of depth.
#include <cstdio>
#include <numbers>

#include "coupling/schemes/steppers.hpp"
#include "fluid/effects/gravity/gravity.hpp"
#include "fluid/participant.hpp"
#include "rigid/forces/gravity.hpp"
#include "rigid/participant.hpp"
#include "rigid/shapes/mass_properties.hpp"
#include "rigid/shapes/shapes.hpp"

using namespace splashdown;

int main() {
  // A wedge of 241 kg/m, its keel on the water at y = 0. A body's frame has its origin at the centre of mass.
  const auto shape = rigid::wedge(std::numbers::pi / 6, 0.5, 0.3);
  const auto properties = rigid::with_mass<2>(shape.at_unit_density, 241);
  rigid::BodySpec<2> wedge{.name = "wedge",
                           .surface = rigid::centred<2>(shape.surface, properties.centre),
                           .mass = properties.mass,
                           .inertia = properties.inertia,
                           .free = {false, true, false}};
  wedge.pose.translate(properties.centre);
  wedge.velocity = {0, -6.15, 0};

  // The tank is a box turned inside out; the water fills it to y = 0. Walls: the bodies' first, in their order.
  const rigid::Shape<2> tank = rigid::box(6, 4), water = rigid::box(6, 3);
  fluid::FluidSpec<2> spec{.size = {.surface = 0.1, .far = 0.3}};
  spec.walls.push_back({.name = "wedge",
                        .surface = {wedge.surface.vertices, wedge.surface.facets},
                        .pose = wedge.pose,
                        .velocity = wedge.velocity,
                        .size = 0.01});
  spec.walls.push_back(
      {.name = "tank", .surface = {tank.surface.vertices, tank.surface.facets.colwise().reverse()}, .size = 0.3});
  spec.walls.back().pose.translation().y() = -1;  // from -3 to 1
  spec.liquids.push_back({{water.surface.vertices.colwise() + Eigen::Vector2d(0, -1.5), water.surface.facets}, {}});

  const Eigen::Vector2d g(0, -9.81);
  std::vector<std::unique_ptr<fluid::Effect<2>>> effects;
  effects.push_back(std::make_unique<fluid::Gravity<2>>(g));
  std::vector<std::unique_ptr<rigid::Force<2>>> forces;
  forces.push_back(std::make_unique<rigid::Gravity<2>>(g));
  auto sea = std::make_unique<fluid::Participant<2>>(std::make_unique<fluid::Fluid<2>>(spec, std::move(effects)));
  auto hull = std::make_unique<rigid::Participant<2>>(
      std::make_unique<rigid::Bodies<2>>(std::vector{wedge}, std::move(forces)));
  const auto& liquid = sea->fluid();
  const auto& bodies = hull->bodies();
  coupling::Simultaneous stepper(std::move(sea), std::move(hull));

  double peak = 0;
  for (double dt = 5e-5; stepper.time() < 0.01; dt = std::min(1.5 * dt, stepper.stable_dt())) {
    auto report = stepper.attempt(dt);
    while (!report.ok() && dt > 1e-8) report = stepper.attempt(dt *= 0.5);  // a refused step leaves no trace
    if (!report.ok()) return std::fprintf(stderr, "%s\n", report.cause.c_str()), 1;
    const double load = liquid.result().loads[0].total()[1];  // at t_n, known between attempt and commit
    peak = std::max(peak, load);
    std::printf("%8.3f ms  %8.3f m/s  %8.2f kN/m\n", 1e3 * stepper.time(), bodies.trials()[0].velocity[1], 1e-3 * load);
    stepper.commit();
  }
  return peak > 0 && bodies.states()[0].velocity[1] > -6.15 ? 0 : 1;
}
