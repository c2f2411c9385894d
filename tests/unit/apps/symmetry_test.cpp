// Scenes that are their own mirror images, and what breaks the mirror.
#include "apps/build/symmetry.hpp"

#include <gtest/gtest.h>

#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::symmetry_test {
namespace {

using Axes = std::vector<char>;

template <int d>
Axes axes_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const auto scene = read_scene_text(text, "scene.toml", overrides).scene;
  return symmetric_axes<d>(scene, scene.bodies.at(0));
}

TEST(Symmetry, of_a_wedge_in_the_middle_of_its_tank_is_broken_by_any_of_its_parts) {
  const auto& wedge = testing::wedge_drop;
  EXPECT_EQ(axes_of<2>(wedge), Axes{1});
  EXPECT_EQ(axes_of<2>(wedge, {"body.wedge.pitch_deg=5"}), Axes{0});
  EXPECT_EQ(axes_of<2>(wedge, {"body.wedge.position.0=0.1"}), Axes{0}) << "the tank";
  EXPECT_EQ(axes_of<2>(wedge, {"body.wedge.velocity.0=1"}), Axes{0});
  EXPECT_EQ(axes_of<2>(wedge, {"body.wedge.spin_deg=1"}), Axes{0});
  EXPECT_EQ(axes_of<2>(wedge, {"body.wedge.centre_of_mass=[0.05, 0.1]"}), Axes{0});
  EXPECT_EQ(axes_of<2>(wedge, {"gravity.acceleration=[1.0, -9.81]"}), Axes{0});
  EXPECT_EQ(axes_of<2>(wedge, {"fluid.region.0.velocity=[1.0, 0.0]"}), Axes{0});
}

TEST(Symmetry, in_space_holds_for_each_horizontal_axis_by_itself) {
  const std::string capsule =
      "dimension = 3\n[time]\nend = 0.1\n[gravity]\n[tank]\nmin = [-3, -3, -2]\nmax = [3, 3, 1]\n[fluid]\ndensity = "
      "1000\n"
      "[[fluid.region]]\nshape = \"box\"\nmin = [-3, -3, -2]\nmax = [3, 3, 0]\n[[body]]\nname = \"capsule\"\n"
      "shape = {type = \"capsule\", radius = 0.2, length = 0.6}\ndensity = 300\nposition = [0, 0, 0.5]\nvelocity = [0, "
      "0, -3]\n";
  EXPECT_EQ(axes_of<3>(capsule), (Axes{1, 1}));
  EXPECT_EQ(axes_of<3>(capsule, {"body.capsule.pitch_deg=10"}), (Axes{0, 1}));
  EXPECT_EQ(axes_of<3>(capsule, {"body.capsule.velocity.0=8"}), (Axes{0, 1}));
  EXPECT_EQ(axes_of<3>(capsule, {"body.capsule.spin_deg=[0, 20, 0]"}), (Axes{0, 1})) << "pitching keeps left and right";
}

// Along the plane effects push to both sides alike.
TEST(Symmetry, of_effects_is_broken_by_what_they_have_across_the_plane) {
  const auto with = [](const std::string& effects) {
    return testing::wedge_drop_with("[output]", effects + "\n[output]");
  };
  for (const char* kept :
       {"[fluid.skin_friction]", "[fluid.form_drag]", "[[body.force]]\nforce = [0, -50]",
        "[body.aero]\narea = 0.5\ndrag = 1", "[body.aero]\narea = 0.5\ndrag = 1\n[wind]\nvelocity = [0, -3]"})
    EXPECT_EQ(axes_of<2>(with(kept)), Axes{1}) << kept;
  for (const char* broken :
       {"[[body.force]]\nforce = [1, -50]", "[[body.force]]\nforce = [0, -50]\npoint = [0.1, 0]",
        "[[body.force]]\nmoment = 3", "[body.aero]\narea = 0.5\nlift = 1",
        "[body.aero]\narea = 0.5\ndrag = 1\npoint = [0.1, 0.1]",
        "[body.aero]\narea = 0.5\ndrag = 1\n[wind]\nvelocity = [2, 0]",
        "[body.aero]\narea = 0.5\ndrag = 1\n[wind]\nvelocity = [0, 0]\n[wind.gust]\nvelocity = [1, 0]\nduration = 1"})
    EXPECT_EQ(axes_of<2>(with(broken)), Axes{0}) << broken;
}

}  // namespace
}  // namespace splashdown::apps::symmetry_test
