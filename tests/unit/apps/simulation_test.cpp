// A scene stepped by hand: what the command does with it, bit for bit; pushes, paths, saving.
#include "apps/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/scene/rules/problems.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::simulation_test {
namespace {

using apps::testing::replaced;

const std::string drop = R"([time]
end = 0.01
[gravity]
[tank]
min = [-1, -0.5]
max = [1, 0.6]
[fluid]
density = 1000
[fluid.size]
surface = 0.04
far = 0.1
[[fluid.region]]
shape = "box"
min = [-1, -0.5]
max = [1, 0]
[[body]]
name = "wedge"
shape = {type = "wedge", deadrise_deg = 30, breadth = 0.4}
density = 300
position = [0, 0.005]
velocity = [0, -4]
size = 0.02
)";

const std::string flight = R"([time]
end = 1
dt_max = 0.01
[gravity]
[[body]]
name = "stone"
shape = {type = "circle", radius = 0.1}
mass = 2
velocity = [3, 4]
)";

TEST(Simulation, knows_every_instant_from_the_start_to_the_end) {
  auto simulation = Simulation::of_text(drop);
  double before = -1;
  while (simulation.advance()) {
    EXPECT_GT(simulation.time(), before);
    before = simulation.time();
    const auto water = simulation.water().value();
    EXPECT_EQ(water.positions.size(), 2 * water.pressure.size());
    EXPECT_EQ(water.positions.size(), water.velocities.size());
    EXPECT_EQ(water.boundary.size(), 2 * water.walls.size());
    EXPECT_NEAR(water.volume, 1, 1e-9);
  }
  EXPECT_DOUBLE_EQ(before, 0.01);
  EXPECT_FALSE(simulation.advance());
  EXPECT_GT(simulation.bodies().at(0).force.y(), 0);
}

TEST(Simulation, knows_nothing_before_the_first_step) {
  auto simulation = Simulation::of_text(drop);
  EXPECT_THROW(simulation.bodies(), std::logic_error);
  EXPECT_THROW(simulation.water(), std::logic_error);
}

TEST(Simulation, goes_on_from_what_was_saved_with_the_same_bits) {
  ScratchFolder folder;
  auto simulation = Simulation::of_text(drop);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.advance());
  simulation.save(folder.path() / "state");
  const double at = simulation.time();
  const auto finish = [](Simulation& of) {
    while (of.advance()) {
    }
    return of.bodies().at(0);
  };
  const auto first = finish(simulation);
  auto other = Simulation::of_text(drop);
  other.restore(folder.path() / "state");
  EXPECT_EQ(other.time(), at);
  const auto second = finish(other);
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.force, second.force);
  EXPECT_EQ(simulation.steps(), other.steps());
  auto another = Simulation::of_text(replaced(drop, "density = 300", "density = 400"));
  EXPECT_THROW(another.restore(folder.path() / "state"), std::runtime_error);
}

TEST(Simulation, bodies_are_pushed_by_what_a_program_says) {
  // Weight taken off: uniform motion.
  SimulationHooks hooks;
  hooks.forces.push_back({"stone", [](double, const BodyNow&) { return SimulationHooks::Push{{0, 2 * 9.81, 0}, {}}; }});
  auto simulation = Simulation::of_text(flight, ".", {}, hooks);
  ASSERT_TRUE(simulation.advance_to(1));
  const auto stone = simulation.bodies().at(0);
  EXPECT_NEAR(stone.position.x(), 3, 1e-12);
  EXPECT_NEAR(stone.position.y(), 4, 1e-12);
  hooks.forces[0].body = "bird";
  EXPECT_THROW(Simulation::of_text(flight, ".", {}, hooks), std::invalid_argument);
}

TEST(Simulation, prescribed_bodies_follow_what_a_program_says) {
  auto text =
      replaced(replaced(flight, "mass = 2\nvelocity = [3, 4]\n", "motion = \"prescribed\"\n"), "end = 1", "end = 0.5");
  SimulationHooks hooks;
  hooks.paths.push_back({"stone", [](double t) {
                           return SimulationHooks::Pose{{std::sin(t), t * t, 0}, Eigen::Matrix3d::Identity()};
                         }});
  auto simulation = Simulation::of_text(text, ".", {}, hooks);
  ASSERT_TRUE(simulation.advance_to(0.5));
  EXPECT_NEAR(simulation.bodies().at(0).position.x(), std::sin(0.5), 1e-12);
  EXPECT_NEAR(simulation.bodies().at(0).position.y(), 0.25, 1e-12);
  EXPECT_THROW(Simulation::of_text(flight, ".", {}, hooks), std::invalid_argument);  // is free there
  hooks.paths[0].pose = [](double) { return SimulationHooks::Pose{{1, 0, 0}, Eigen::Matrix3d::Identity()}; };
  EXPECT_THROW(Simulation::of_text(text, ".", {}, hooks), std::invalid_argument);  // begins elsewhere
}

TEST(Simulation, wrong_scenes_are_told_as_the_command_tells_them) {
  EXPECT_THROW(Simulation::of_text(replaced(drop, "density = 300", "density = -3")), apps::SceneError);
}

}  // namespace
}  // namespace splashdown::simulation_test
