// A step of the fluid alone, walls moved by hand: what its parts do for each other.
#include <gtest/gtest.h>

#include <set>

#include "fluid/effects/viscosity/viscosity.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::fluid_step_test {
namespace {

constexpr double width = 1, depth = 0.5, size = 0.05;
constexpr double moment = 1e-6;  // a step in which nothing moves

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
  ASSERT_TRUE(water.solve(jerk).status.ok());
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
  const std::vector<Twist<2>> still{Twist<2>::Zero()};
  ASSERT_TRUE(water.begin(moment, moment, {}).ok());
  ASSERT_TRUE(water.solve(still).status.ok());
  const auto& load = water.result().loads[0];
  EXPECT_GT(load.repair[0], 0);
  EXPECT_LT(std::abs(load.physical[0]), 0.005 * load.repair[0]);
}

TEST(FluidStep, tells_a_pressure_without_what_corrections_add_from_node_to_node) {
  // A jerked tank, whose water moves anyhow from node to node. Along its wall: fourth differences, which see little but what
  // alternates, and the mean, to the second order of the smoothing in a twentieth of the depth.
  auto spec = scenes::still_water(width, depth, 0.5 * size);
  spec.liquids[0].velocity = [](const Vec<2>& x) {
    return Vec<2>(0.1 * std::sin(1e4 * x.x()), 0.1 * std::sin(1e4 * x.y()));
  };
  Fluid<2> water(std::move(spec), scenes::no_effects());
  const double dt = 1e-3;
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  ASSERT_TRUE(water.solve(std::vector<Twist<2>>{{1, 0, 0}}).status.ok());
  std::vector<std::size_t> wall;
  for (std::size_t i = 0; i < water.nodes().size(); ++i)
    if (std::abs(water.nodes().x[i].x() + 0.5 * width) < 0.01 * size) wall.push_back(i);
  std::ranges::sort(wall, {}, [&](std::size_t i) { return water.nodes().x[i].y(); });
  const auto along_wall = [&](const std::vector<double>& p) {
    double roughness = 0, mean = 0;
    for (std::size_t k = 2; k + 2 < wall.size(); ++k) {
      const double fourth = p[wall[k - 2]] - 4 * p[wall[k - 1]] + 6 * p[wall[k]] - 4 * p[wall[k + 1]] + p[wall[k + 2]];
      roughness += fourth * fourth, mean += p[wall[k]] / static_cast<double>(wall.size() - 4);
    }
    return std::pair{std::sqrt(roughness), mean};
  };
  const auto& result = water.result();
  const auto [rough, mean] = along_wall(result.carried);
  const auto [smooth, same] = along_wall(result.pressure);
  EXPECT_LT(smooth, 0.5 * rough);
  EXPECT_NEAR(same, mean, 0.01 * mean);
  EXPECT_EQ(std::vector<double>(water.pressure().begin(), water.pressure().end()), result.pressure);
}

// What water gains and its tank gets in the last of equal steps with these velocities of the tank, in which nothing moves.
struct Exchange {
  double momentum, impulse;
};
Exchange last_step(FluidSpec<2> spec, std::unique_ptr<Viscosity<2>> viscosity, const std::vector<double>& speeds) {
  auto effects = scenes::no_effects();
  if (viscosity) effects.push_back(std::move(viscosity));
  Fluid<2> water(std::move(spec), std::move(effects));
  for (std::size_t k = 0;; ++k) {
    EXPECT_TRUE(water.begin(moment, moment, {}).ok());
    EXPECT_TRUE(water.solve(std::vector<Twist<2>>{{speeds[k], 0, 0}}).status.ok());
    if (k + 1 == speeds.size()) break;
    water.commit(water.wall_poses());
  }
  const auto volumes = nodal_volumes(water.mesh(), water.nodes().x);
  double momentum = 0;  // after equal steps the velocity at t_n is the mean of those before and after
  for (std::size_t i = 0; i < volumes.size(); ++i)
    momentum += 2 * water.density() * volumes[i] * (water.velocity_n(i).x() - water.nodes().v[i].x());
  return {momentum, moment * water.result().loads[0].total()[0]};
}

TEST(FluidStep, what_a_tank_gets_the_water_loses_corners_included) {
  // The nodes in the lower corners move with the tank and hand their momentum over.
  const auto [momentum, impulse] = last_step(scenes::still_water(width, depth, 2 * size), nullptr, {0, 1});
  EXPECT_NEAR(impulse, -momentum, 1e-6 * momentum);
}

TEST(FluidStep, what_a_tank_gets_by_shear_the_water_loses_too) {
  // Jerked, water slips along the floor; in the next step that takes a layer along, (nu dt)^(1/2) thick: two elements.
  auto spec = scenes::still_water(width, depth, 2 * size);
  const double viscosity = spec.density * 16 * size * size / moment;
  const double jerk = last_step(spec, nullptr, {0, 1}).momentum;
  spec.walls[0].sticks = true;
  const auto [momentum, impulse] = last_step(spec, std::make_unique<Viscosity<2>>(viscosity), {0, 1, 1});
  EXPECT_GT(momentum, 0.1 * jerk);
  EXPECT_NEAR(impulse, -momentum, 1e-6 * momentum);
}

TEST(FluidStep, a_tank_that_turns_while_it_travels_turns_its_water_as_one_that_stays) {
  // Galilei: the flux of its walls is that of a turn about where their centre is halfway. About where it was, water and tank would
  // differ by half of dt (turn x speed), a tenth of the speed of the tank's ends.
  const double dt = 0.01, turn = 0.2, speed = 0.1 * width / dt;
  std::array<std::vector<Vec<2>>, 2> v;
  std::array<Wrench<2>, 2> load;
  for (int travels : {0, 1}) {
    const Vec<2> along = travels * speed * Vec<2>::UnitX();
    auto spec = scenes::still_water(width, depth, size);
    spec.liquids[0].velocity = [along](const Vec<2>&) { return along; };
    spec.walls[0].velocity << along, 0;
    Fluid<2> water(std::move(spec), scenes::no_effects());
    const std::vector<Twist<2>> motion{{along.x(), along.y(), turn}};
    ASSERT_TRUE(water.begin(dt, dt, {}).ok());
    ASSERT_TRUE(water.solve(motion).status.ok());
    load[travels] = dt * water.result().loads[0].total();
    water.commit(std::vector<Isometry<2>>{moved<2>(Isometry<2>::Identity(), motion[0], dt)});
    for (const auto& velocity : water.nodes().v) v[travels].push_back(velocity - along);
  }
  const double roundoff =
      1e6 * scenes::eps * speed;  // of (size / width)^-2 unknowns, times the matrix's condition, as much again
  ASSERT_EQ(v[0].size(), v[1].size());
  for (std::size_t i = 0; i < v[0].size(); ++i) EXPECT_LE((v[0][i] - v[1][i]).norm(), roundoff) << i;
  EXPECT_LE((load[0] - load[1]).norm(), 1000 * width * depth * roundoff);
}

TEST(FluidStep, water_that_turns_around_an_edge_has_the_velocity_of_where_it_comes_from) {
  // A stream past a box that stands still: d u / dt + u . grad u = 0 along its sides, upwind, is what moves on at its corners.
  auto spec = scenes::still_water(2 * width, 2 * depth, size);
  spec.liquids[0].velocity = [](const Vec<2>&) { return Vec<2>(1, 0); };
  spec.walls.push_back(scenes::wall("box", scenes::rectangle({-0.2, -0.7}, {0.2, -0.3}), size));
  Fluid<2> water(std::move(spec), scenes::no_effects());
  const double dt = 0.1 * size;
  const std::vector<Twist<2>> still(2, Twist<2>::Zero());
  const std::vector<Isometry<2>> poses(2, Isometry<2>::Identity());
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  ASSERT_TRUE(water.solve(still).status.ok());
  water.commit(poses);
  ASSERT_TRUE(water.begin(dt, dt, {}).ok());
  ASSERT_TRUE(water.solve(still).status.ok());
  const Nodes<2> before = water.nodes();
  const auto boundary = water.mesh().boundary;
  std::vector<Vec<2>> u;  // after equal steps the velocity at t_n is the mean of those before and after
  for (std::size_t i = 0; i < before.size(); ++i) u.push_back(2 * water.velocity_n(i) - before.v[i]);
  water.commit(poses);
  const Nodes<2>& after = water.nodes();
  std::set<int> corners;
  for (const auto& f : boundary)
    for (int k : {0, 1}) {
      const int corner = f.nodes[k], upstream = f.nodes[1 - k];
      if (f.wall != 1 || before.tie[corner].vertex < 0) continue;
      const Vec<2> from = after.x[upstream] - after.x[corner];
      const double passes = -dt * u[corner].dot(from) / from.squaredNorm();
      if (passes <= 0) continue;
      EXPECT_TRUE(corners.insert(corner).second) << "the water comes from one side";
      const Vec<2> change = passes * (u[upstream] - u[corner]);
      EXPECT_GT(change.norm(), 0.01);
      EXPECT_LE((after.v[corner] - u[corner] - change).norm(), 100 * scenes::eps);
    }
  EXPECT_EQ(corners.size(), 4u);
}

// Momentum of water and tank, over that before, when a drop, a triangle on its tip, `breadth` wide and `high`, has fallen `deep`
// into a pool at rest.
Vec<2> landed_momentum(double breadth, double deep, double high = 0.5 * size) {
  const double gap = 0.05 * size, speed = 1, falls = (gap + deep) / speed;
  auto spec = scenes::still_water(width, depth, size);
  spec.step.dt_max = falls;
  spec.liquids.push_back({scenes::outline({{-0.5 * breadth, gap + high}, {0, gap}, {0.5 * breadth, gap + high}}),
                          [=](const Vec<2>&) { return Vec<2>(speed, -speed); }});
  Fluid<2> water(std::move(spec), scenes::no_effects());
  auto momentum = [&] {
    Vec<2> sum = Vec<2>::Zero();
    for (std::size_t i = 0; i < water.nodes().size(); ++i)
      sum += water.density() * water.nodes().volume[i] * water.nodes().v[i];
    return sum;
  };
  const Vec<2> before = momentum();
  Vec<2> given = Vec<2>::Zero();
  for (const double dt : {falls, moment}) {
    EXPECT_TRUE(water.begin(dt, dt, {}).ok());
    EXPECT_TRUE(water.solve(std::vector<Twist<2>>{Twist<2>::Zero()}).status.ok());
    given += dt * water.result().loads[0].total().head<2>();
    water.commit(water.wall_poses());
  }
  return (momentum() + given).cwiseQuotient(before);
}

TEST(FluidStep, a_drop_that_lands_brings_its_own_momentum_and_no_more) {
  // Up to fourteen times its volume counts to its nodes then, water of the pool: at the drop's speed that would be up to four times
  // its momentum. What lies over each other has gone from the mesh, with no more momentum than the drop has there.
  for (const double breadth : {0.5 * size, size})
    for (const double deep : {0.1 * size, 0.2 * size, 0.4 * size}) {
      const Vec<2> share = landed_momentum(breadth, deep);
      EXPECT_GT(share.minCoeff(), 0) << breadth << ' ' << deep;
      EXPECT_LE(share.maxCoeff(), 1) << breadth << ' ' << deep;
    }
}

TEST(FluidStep, water_between_a_drop_and_its_pool_comes_at_the_mean_velocity_of_both) {
  // At that of the nodes around it, it would bring a quarter to two fifths of the drop's momentum along.
  for (const double deep : {0.1 * size, 0.2 * size, 0.4 * size}) {
    const Vec<2> share = landed_momentum(2 * size, deep, size);
    EXPECT_GT(share.minCoeff(), 0.95) << deep;
    EXPECT_LT(share.maxCoeff(), 1.05) << deep;
  }
}

}  // namespace
}  // namespace splashdown::fluid::fluid_step_test
