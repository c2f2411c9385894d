// Scenes with a fluid between sides: what is read, what is refused, what is run.
#include <gtest/gtest.h>

#include <sstream>

#include "apps/build/build.hpp"
#include "apps/scene/read/read.hpp"
#include "fluid/ale/fluid.hpp"

namespace splashdown::apps::scene_test {
namespace {

const std::string channel = R"(
[time]
end = 1.0
dt_max = 0.05
[fluid]
formulation = "ale"
density = 1000
[fluid.viscosity]
dynamic = 10.0
[fluid.domain]
min = [0.0, 0.0]
max = [3.0, 1.0]
[fluid.sides]
bottom = "no_slip"
top = "no_slip"
[fluid.inflow]
velocity = [0.5, 0.0]
profile = "parabolic"
ramp = 0.2
[fluid.size]
far = 0.3
hull = 0.08
[[body]]
name = "plate"
motion = "fixed"
shape = {type = "box", width = 0.4, height = 0.1}
position = [1.0, 0.45]
)";

Scene read(const std::string& text, std::vector<std::string> set = {}) {
  return read_scene_text(text, "scene.toml", set).scene;
}

/// What a scene is refused with.
std::string refusal(const std::string& text, std::vector<std::string> set = {}) {
  try {
    read(text, set);
  } catch (const SceneError& error) {
    std::string all;
    for (const auto& message : error.messages()) all += message + "\n";
    return all;
  }
  return {};
}

TEST(AleScene, is_read_with_its_defaults) {
  const auto scene = read(channel, {"fluid.size.refine=2"});
  ASSERT_TRUE(scene.ale);
  EXPECT_TRUE(scene.has_fluid());
  EXPECT_EQ(scene.fluid_density(), 1000);
  EXPECT_EQ(scene.ale->sides.all(), (std::array<std::string, 4>{"inflow", "outflow", "no_slip", "no_slip"}));
  EXPECT_EQ(scene.ale->far, 0.15);
  EXPECT_EQ(scene.bodies[0].size, 0.04);
  EXPECT_EQ(scene.time.dt_max, 0.025);
  EXPECT_EQ(scene.ale->scheme, "midpoint");
}

TEST(AleScene, makes_the_inflow_that_it_says) {
  const auto spec = ale_spec(read(channel));
  EXPECT_NEAR(spec.inflow({0, 0.5}, 1).x(), 1.5 * 0.5, 1e-15);  // a parabola's top over its mean
  EXPECT_EQ(spec.inflow({0, 1}, 1).x(), 0);
  EXPECT_NEAR(spec.inflow({0, 0.5}, 0.1).x(), 0.75 * 0.5, 1e-15);  // midway in the ramp
  EXPECT_EQ(spec.scheme.theta, 0.5);
  EXPECT_TRUE(ale_spec(read(channel, {"fluid.ale.scheme=steady"})).scheme.is_steady);
  EXPECT_EQ(spec.extension, ale::ExtensionLaw::laplace);
  EXPECT_EQ(ale_spec(read(channel, {"fluid.ale.extension=biharmonic"})).extension, ale::ExtensionLaw::biharmonic);
}

TEST(AleScene, refuses_what_cannot_be) {
  const std::pair<const char*, const char*> wrong[] = {
      {"fluid.domain.max=[-1.0, 1.0]", "must lie above fluid.domain.min"},
      {"fluid.sides.right=no_slip", "has to leave"},
      {"fluid.inflow.velocity=[-0.5, 0.0]", "does not come in through the left side"},
      {"fluid.size.far=0.7", "half of the box's smallest side"},
      {"fluid.size.hull=0.5", "must not exceed fluid.size.far"},
      {"body.plate.position=[2.9, 0.5]", "does not lie an element or more inside"},
      {"body.plate.size=0.25", "half of the length"},
      {"fluid.viscosity.dynamic=0", "must be positive"},
      {"fluid.ale.scheme=leapfrog", "must be"},
      {"fluid.ale.extension=springs", "must be"},
      {"fluid.grid.size=0.1", "belongs to formulation = \"vortex\""},
      {"tank.min=[0.0, 0.0]", "sides of its own"}};
  for (const auto& [set, rule] : wrong) {
    std::vector<std::string> all = {set};
    if (std::string(set).starts_with("tank")) all.push_back("tank.max=[3.0, 1.0]");
    EXPECT_NE(refusal(channel, all).find(rule), std::string::npos) << set << ": " << refusal(channel, all);
  }
  EXPECT_NE(
      refusal(channel, {"body.plate.motion=prescribed", "body.plate.velocity=[0.1, 0.0]", "fluid.ale.scheme=steady"})
          .find("not steady"),
      std::string::npos);
}

// Fixed bodies are one obstacle where they overlap, others may not.
TEST(AleScene, lets_fixed_bodies_overlap) {
  const std::string more = channel + R"(
[[body]]
name = "head"
motion = "fixed"
shape = {type = "circle", radius = 0.15}
position = [0.8, 0.45]
)";
  EXPECT_EQ(refusal(more), "");
  EXPECT_NE(refusal(more, {"body.head.motion=free", "body.head.density=1000"}).find("overlaps"), std::string::npos);
}

// The plate resists the stream, and a run that is stored in its middle goes on with the same bits.
TEST(AleScene, runs_and_resumes) {
  const auto scene = read(channel);
  auto straight = build_world<2>(scene), resumed = build_world<2>(scene);
  const auto step = [](World<2>& world) {
    const auto report = world.stepper->attempt(0.05);
    ASSERT_TRUE(report.ok()) << report.cause;
    world.stepper->commit();
  };
  for (int k = 0; k < 8; ++k) step(straight);
  std::stringstream state;
  straight.stepper->save(state);
  resumed.stepper->load(state);
  for (int k = 0; k < 3; ++k) {
    step(straight);
    step(resumed);
  }
  EXPECT_GT(straight.fluid->loads()[0].physical[0], 100);  // N/m; rho U^2 h is 25
  EXPECT_LT(straight.fluid->loads()[0].physical[0], 2000);
  std::ostringstream a, b;
  straight.stepper->save(a);
  resumed.stepper->save(b);
  EXPECT_EQ(a.str(), b.str());
}

double number_of_meshes(const World<2>& world) {
  for (const auto& [name, value] : world.fluid->diagnostics())
    if (name == "remeshings") return value;
  return -1;
}

// A plate that is moved by three of its lengths: with new meshes, or as far as the first one goes.
TEST(AleScene, makes_new_meshes_unless_it_is_told_not_to) {
  EXPECT_TRUE(ale_spec(read(channel)).remesh);
  for (const std::string remesh : {"automatic", "never"}) {
    auto world = build_world<2>(read(
        channel, {"body.plate.motion=prescribed", "body.plate.velocity=[1.5, 0.0]", "fluid.ale.remesh=" + remesh}));
    std::string cause;
    for (int k = 0; k < 20 && cause.empty(); ++k) {
      const auto report = world.stepper->attempt(0.04);
      if (report.ok())
        world.stepper->commit();
      else
        cause = report.cause;
    }
    if (remesh == "automatic") {
      EXPECT_EQ(cause, "");
      EXPECT_GE(number_of_meshes(world), 2);
    } else {
      EXPECT_NE(cause.find("folds"), std::string::npos) << cause;
      EXPECT_EQ(number_of_meshes(world), 0);
    }
  }
  EXPECT_NE(refusal(channel, {"fluid.ale.remesh=often"}).find("must be"), std::string::npos);
}

// A body as heavy as the fluid drifts with the stream.
TEST(AleScene, carries_a_free_body) {
  const auto scene = read(channel, {"body.plate.motion=free", "body.plate.density=1000"});
  auto world = build_world<2>(scene);
  for (int k = 0; k < 12; ++k) {
    const auto report = world.stepper->attempt(0.05);
    ASSERT_TRUE(report.ok()) << report.cause;
    EXPECT_EQ(report.passes, 1);
    world.stepper->commit();
  }
  EXPECT_GT(world.bodies->state(0).velocity[0], 0.3);
  EXPECT_LT(world.bodies->state(0).velocity[0], 0.75);
}

}  // namespace
}  // namespace splashdown::apps::scene_test
