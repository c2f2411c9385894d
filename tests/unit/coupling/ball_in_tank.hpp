// A ball and a tank of water in space, which the tests of stability and the benchmark share.
#pragma once

#include "fluid/effects/gravity/gravity.hpp"
#include "rigid/forces/gravity.hpp"
#include "rigid/shapes/solids.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::coupling::scenes {

/// Water up to z = 0 in a tank of 4 m x 4 m x 4 m, half full.
struct BallInTank {
  static constexpr double radius = 0.5, half = 2;
  fluid::FluidSpec<3> fluid;
  rigid::BodySpec<3> ball;
};

/// The ball's centre is at z = height, and it moves downward at `speed`; elements of h_ball at its hull, h_tank elsewhere.
inline BallInTank ball_in_tank(double density_ratio, double height, double speed, double h_ball, double h_tank,
                               int edges_around = rigid::default_around) {
  constexpr double half = BallInTank::half;
  BallInTank scene;
  const auto shape = rigid::sphere(BallInTank::radius, edges_around);
  const auto properties = rigid::with_density<3>(shape.at_unit_density, density_ratio * water);
  auto& ball = scene.ball;
  ball.name = "ball";
  ball.surface = shape.surface;
  ball.mass = properties.mass;
  ball.inertia = properties.inertia;
  ball.free.fill(true);
  ball.pose.translation().z() = height;
  ball.velocity[2] = -speed;
  auto hull = fluid::scenes::wall<3>("ball", {shape.surface.vertices, shape.surface.facets}, h_ball);
  hull.pose = ball.pose;
  hull.velocity = ball.velocity;
  const auto tank = fluid::scenes::block({-half, -half, -half}, {half, half, half});
  scene.fluid.size = {.surface = h_tank, .far = h_tank, .growth = 0.4};
  scene.fluid.walls = {hull, fluid::scenes::wall<3>("tank", fluid::scenes::turned_inside_out(tank), h_tank)};
  scene.fluid.liquids.push_back({fluid::scenes::block({-half, -half, -half}, {half, half, 0}), {}});
  return scene;
}

inline std::unique_ptr<fluid::Fluid<3>> water_of(const BallInTank& scene) {
  std::vector<std::unique_ptr<fluid::Effect<3>>> effects;
  effects.push_back(std::make_unique<fluid::Gravity<3>>(fluid::Vec<3>(0, 0, -g)));
  return std::make_unique<fluid::Fluid<3>>(scene.fluid, std::move(effects));
}

inline std::unique_ptr<rigid::Bodies<3>> bodies_of(const BallInTank& scene) {
  std::vector<std::unique_ptr<rigid::Force<3>>> forces;
  forces.push_back(std::make_unique<rigid::Gravity<3>>(rigid::Vec<3>(0, 0, -g)));
  return std::make_unique<rigid::Bodies<3>>(std::vector{scene.ball}, std::move(forces));
}

}  // namespace splashdown::coupling::scenes
