// A step of the fluid alone, walls moved by hand: what its parts do for each other.
#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid {
namespace {

constexpr double width = 1, depth = 0.5, size = 0.05;

// Wetted nodes below the free surface that are tied to the upright wall at x = -width/2 (side = -1) or width/2 (+1).
int tied_to(const Fluid<2>& water, double side) {
  int count = 0;
  for (std::size_t i = 0; i < water.nodes().size(); ++i) {
    const auto& x = water.nodes().x[i];
    count += water.nodes().tie[i].wall == 0 && std::abs(x.x() - side * 0.5 * width) < 0.1 * size;
  }
  return count;
}

TEST(FluidStep, air_gets_behind_a_wall_that_is_pulled_from_the_water) {
  // Water at rest without gravity, whose tank is jerked to the right: its left wall pushes, its right one pulls.
  Fluid<2> water(scenes::still_water(width, depth, size), scenes::no_effects());
  const double dt = 1e-3;
  const std::vector<Twist<2>> jerk{{1, 0, 0}};
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  const int left = tied_to(water, -1), right = tied_to(water, 1);
  ASSERT_TRUE(water.solve(jerk).ok());
  water.commit(std::vector<Isometry<2>>{moved<2>(Isometry<2>::Identity(), jerk[0], dt)});
  EXPECT_EQ(tied_to(water, 1), right - 1) << "a row a step, from the contact line";
  EXPECT_EQ(tied_to(water, -1), left);
}

TEST(FluidStep, what_a_velocity_lacks_of_keeping_the_volume_is_repaired_and_loads_nothing) {
  // All of the water flows to the right into the wall: nobody has done that, it is no load. What one pass of the repair leaves of it
  // counts as pressure, 0.0109 of the repair here, and 0.0022 after the second: half of the first is asked for.
  auto spec = scenes::still_water(width, depth, size);
  spec.liquids[0].velocity = [](const Vec<2>&) { return Vec<2>(1, 0); };
  Fluid<2> water(std::move(spec), scenes::no_effects());
  const double dt = 1e-6;  // nothing moves
  const std::vector<Twist<2>> still{Twist<2>::Zero()};
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  ASSERT_TRUE(water.solve(still).ok());
  const auto& load = water.loads()[0];
  EXPECT_GT(load.repair[0], 0);
  EXPECT_LT(std::abs(load.physical[0]), 0.005 * load.repair[0]);
}

TEST(FluidStep, what_a_tank_gets_the_water_loses_corners_included) {
  // The nodes in the lower corners move with the tank and hand their momentum over.
  Fluid<2> water(scenes::still_water(width, depth, 2 * size), scenes::no_effects());
  const double dt = 1e-6;  // nothing moves
  const std::vector<Twist<2>> still{Twist<2>::Zero()}, jerk{{1, 0, 0}};
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  ASSERT_TRUE(water.solve(still).ok());
  water.commit(water.wall_poses());
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  ASSERT_TRUE(water.solve(jerk).ok());
  const auto volumes = nodal_volumes(water.mesh(), water.nodes().x);
  double momentum = 0;  // after equal steps the velocity at t_n is the mean of those before and after
  for (std::size_t i = 0; i < volumes.size(); ++i)
    momentum += water.density() * volumes[i] * (2 * water.velocity_n(i).x() - water.nodes().v[i].x());
  EXPECT_NEAR(dt * water.loads()[0].total()[0], -momentum, 1e-6 * momentum);
}

}  // namespace
}  // namespace splashdown::fluid
