// Scenes of a fluid on a grid: what they say, what is refused with which cure, what a world of them is.
#include <gtest/gtest.h>

#include "apps/build/build.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::apps::vortex_scene_test {
namespace {

const std::string head =
    "[time]\nend = 1\n[fluid]\nformulation = \"vortex\"\ndensity = 2\nviscosity = {dynamic = 0.02}\n";
const std::string grid = "grid = {min = [-1, -1], max = [2, 1], size = 0.05}\n";
const std::string body = "[[body]]\nname = \"a\"\nshape = {type = \"circle\", radius = 0.2}\n";
const std::string fixed = body + "motion = \"fixed\"\n";

Scene scene_of(const std::string& text, const std::vector<std::string>& set = {}) {
  return read_scene_text(text, "test.toml", set).scene;
}
std::string refusal_of(const std::string& text) {
  try {
    scene_of(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(VortexScene, has_a_fluid_that_is_no_liquid_with_a_surface) {
  const auto scene = scene_of(head + grid + fixed);
  ASSERT_TRUE(scene.vortex);
  EXPECT_FALSE(scene.fluid);
  EXPECT_TRUE(scene.has_fluid());
  EXPECT_EQ(scene.fluid_density(), 2);
  EXPECT_EQ(scene.vortex->sides, "free");
  EXPECT_EQ(scene.vortex->smoothing, 0);
  EXPECT_EQ(scene.bodies[0].size, 0.05);  // of what records look at on hulls
  EXPECT_EQ(scene_of(head + grid + body + "density = 1\n").vortex->smoothing, 0.5);
  EXPECT_EQ(scene_of(head + grid + fixed, {{"fluid.size.refine=2"}}).vortex->size, 0.025);
}

TEST(VortexScene, becomes_a_grid_that_fast_transforms_like_around_what_it_says) {
  const auto spec = vortex_spec(scene_of(head + "stream = {velocity = [[0, 0, 0], [2, 1, 0]]}\n" + grid + fixed));
  EXPECT_EQ(spec.grid.nx, 60);
  EXPECT_EQ(spec.grid.ny, 40);
  EXPECT_NEAR(spec.viscosity, 0.01, 1e-15);
  EXPECT_NEAR(spec.stream(1).x(), 0.5, 1e-15);
  EXPECT_NEAR(spec.stream(5).x(), 1, 1e-15);
  const auto other = vortex_spec(scene_of(head + "grid = {min = [-1, -1], max = [2.1, 1], size = 0.05}\n" + fixed));
  EXPECT_EQ(other.grid.nx, 64);
  EXPECT_NEAR(other.grid.min.x() + other.grid.max().x(), 1.1, 1e-12);
}

TEST(VortexScene, names_the_effects_that_a_grid_does_not_carry) {
  for (const char* table : {"form_drag = {}\n", "compressibility = {}\n", "skin_friction = {}\n"})
    EXPECT_NE(refusal_of(head + grid + table + fixed).find("does not carry this effect"), std::string::npos) << table;
  EXPECT_NE(refusal_of(head + grid + "monolithic = {tolerance = 1e-8}\n" + fixed).find("has none"), std::string::npos);
}

TEST(VortexScene, wind_is_its_stream) {
  const std::string wind = "[wind]\nvelocity = [3, 0]\ngust = {velocity = [0, 2], start = 1, duration = 2}\n";
  const auto spec = vortex_spec(scene_of(head + grid + wind + fixed));
  EXPECT_EQ(spec.stream(0.5), Vec<2>(3, 0));
  EXPECT_NEAR((spec.stream(2) - Vec<2>(3, 2)).norm(), 0, 1e-14);
  EXPECT_NE(refusal_of(head + "stream = {velocity = [1, 0]}\n" + grid + wind + fixed).find("both say"),
            std::string::npos);
  EXPECT_NE(
      refusal_of(head + grid + "[wind]\nvelocity = [3, 0]\nprofile = \"log\"\n" + fixed).find("must be \"uniform\""),
      std::string::npos);
}

TEST(VortexScene, with_a_tank_has_walls_inside_of_its_grid) {
  const auto scene = scene_of(head + "grid = {size = 0.05}\n[tank]\nmin = [-1, -1]\nmax = [1, 1]\n" + fixed);
  const auto spec = vortex_spec(scene);
  EXPECT_EQ(spec.sides, vortex::SideKind::slip);
  EXPECT_LE(spec.grid.min.x(), -1.2 + 1e-12);
  ASSERT_EQ(spec.walls.size(), 2u);
  EXPECT_EQ(spec.walls[1].name, "tank");
}

TEST(VortexScene, is_stepped_like_any_other) {
  const auto scene = scene_of("[gravity]\n" + head + grid + body + "density = 1\n");
  auto world = build_world<2>(scene);
  ASSERT_TRUE(world.fluid && world.bodies);
  EXPECT_TRUE(world.stepper->attempt(1e-3).ok());
  world.stepper->commit();
  EXPECT_GT(world.bodies->state(0).velocity[1], 0);  // lighter than the fluid
  EXPECT_EQ(world.fluid->points().size(), world.fluid->pressure().size());
}

struct Bad {
  const char* name;
  std::string text, says;
};

TEST(VortexScene, what_cannot_be_is_refused_with_rule_and_cure) {
  const Bad all[] = {
      {"body outside", head + grid + fixed + "position = [1.9, 0]\n",
       "does not lie six squares or more inside the grid"},
      {"thin body",
       head + grid + "[[body]]\nname = \"a\"\nmotion = \"fixed\"\nshape = {type = \"box\", width = 1, height = 0.08}\n",
       "less than two squares"},
      {"no grid", head + fixed, "fluid.grid"},
      {"few squares", head + "grid = {min = [0, 0], max = [1, 1], size = 0.1}\n" + fixed,
       "16 squares or more each way"},
      {"too many squares", head + "grid = {min = [-1, -1], max = [1, 1], size = 1e-5}\n" + fixed, "squares at most"},
      {"slip sides between squares",
       head + "grid = {min = [-1, -1], max = [1.03, 1], size = 0.05, sides = \"slip\"}\n" + fixed,
       "multiple of four squares"},
      {"local term", head + grid + body + "density = 1\n[coupling]\ninterface_term = \"robin\"\n",
       "must be \"rigid\" or \"none\""},
      {"a surface's record", head + grid + fixed + "[[record]]\nkind = \"surface_elevation\"\nname = \"g\"\nx = 0\n",
       "there is no free surface"},
      {"regions", head + grid + "[[fluid.region]]\nshape = \"box\"\nmin = [0, 0]\nmax = [1, 1]\n" + fixed, "region"},
      {"courant", "[time]\nend = 1\ncfl = 1.5\n" + head.substr(head.find("[fluid]")) + grid + fixed, "time.cfl"},
  };
  for (const auto& bad : all)
    EXPECT_NE(refusal_of(bad.text).find(bad.says), std::string::npos) << bad.name << ": " << refusal_of(bad.text);
}

TEST(VortexScene, in_space_there_is_none) {
  EXPECT_NE(refusal_of("dimension = 3\n[time]\nend = 1\n[fluid]\nformulation = \"vortex\"\ndensity = 1\n"), "");
}

TEST(Oscillation, is_harmonic_about_the_position) {
  const auto scene = scene_of(
      "[time]\nend = 2\n[[body]]\nname = \"a\"\nmotion = \"prescribed\"\nposition = [1, 2]\nshape = {type = "
      "\"circle\", radius = "
      "0.2}\noscillation = {frequency = 0.5, amplitude = [0.1, 0], phase_deg = 30, pitch_deg = 10, pitch_phase_deg = "
      "90}\n");
  const auto spec = body_spec<2>(scene.bodies[0]);
  const double w = M_PI;
  for (const double t : {0., 0.3, 1.7}) {
    EXPECT_NEAR(spec.path(t).translation().x(), 1 + 0.1 * std::sin(w * t + M_PI / 6), 1e-14);
    const double angle = 10 * M_PI / 180 * std::cos(w * t);
    EXPECT_NEAR(spec.path(t).linear()(1, 0), std::sin(angle), 1e-14);
  }
  EXPECT_NEAR(spec.velocity[0], 0.1 * w * std::cos(M_PI / 6), 1e-14);
  EXPECT_NEAR(spec.velocity[2], 0, 1e-14);
  EXPECT_NE(refusal_of(
                "[time]\nend = 2\n[[body]]\nname = \"a\"\nmotion = \"fixed\"\nshape = {type = \"circle\", radius = 1}\n"
                "oscillation = {frequency = 1}\n"),
            "");
}

}  // namespace
}  // namespace splashdown::apps::vortex_scene_test
