// [[line]]: what is read, built, refused and asked about.
#include "apps/effects/lines/lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/build/build.hpp"
#include "apps/check/questions.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::lines_test {
namespace {

using testing::Mistake;

/// The wedge on a riser; its table begins in line 26.
const std::string wedge_on_riser = testing::wedge_drop_with("[output]", R"([[line]]
name = "riser"
body = "wedge"
anchor = [0, 1]
length = 0.9
stiffness = 1e4
[output])");

std::string with(const std::string& from, const std::string& to) { return testing::replaced(wedge_on_riser, from, to); }

Scene lines_scene(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

TEST(Lines, are_read_with_their_defaults) {
  const auto scene = lines_scene(wedge_on_riser);
  const auto* lines = scene.effects.find<Lines>();
  ASSERT_NE(lines, nullptr);
  ASSERT_EQ(lines->all.size(), 1u);
  const LineEntry& line = lines->all[0];
  EXPECT_EQ(line.name, "riser");
  EXPECT_EQ(line.body, 0u);
  EXPECT_EQ(line.point, Point::Zero());
  EXPECT_EQ(stiffness_of(line), 1e4);
  EXPECT_EQ(line.damping, 0);
  EXPECT_FALSE(line.catenary || line.canopy || line.other || line.release.time || line.release.load ||
               line.release.wets);
  EXPECT_NEAR(ends_at_start(scene, line).apart(), 0.99, 1e-12);
}

TEST(Lines, are_forces_that_are_there_or_not) {
  const auto counted = [](const Scene& scene) { return parts_of<2>(scene).forces.size(); };
  EXPECT_EQ(counted(lines_scene(wedge_on_riser)), counted(lines_scene(testing::wedge_drop)) + 1);
  EXPECT_EQ(lines_scene(testing::wedge_drop).effects.find<Lines>(), nullptr);
}

TEST(Lines, hold_bodies_that_a_path_lets_go) {
  const auto prescribed = with("free = [\"y\"]", "motion = \"prescribed\"");
  EXPECT_NO_THROW(lines_scene(testing::replaced(prescribed, "[output]", "[body.release]\nat = \"contact\"\n[output]")));
}

TEST(Lines, have_columns_of_their_names) {
  const auto names = [](const std::string& text) {
    std::vector<std::string> all;
    for (const auto& [name, value] : bodies_of<2>(lines_scene(text))->diagnostics()) all.push_back(name);
    return all;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(wedge_on_riser), (Names{"riser_tension", "riser_length"}));
  EXPECT_EQ(names(with("stiffness = 1e4", "axial_stiffness = 1e4\ncatenary = {weight = 10, floor = \"none\"}")),
            (Names{"riser_tension", "riser_length", "riser_on_floor", "riser_anchor_tension"}));
  EXPECT_EQ(names(with("anchor = [0, 1]", "canopy = {position = [0, 1], mass = 1, drag_area = 5}")),
            (Names{"riser_tension", "riser_length", "riser_canopy_x", "riser_canopy_y", "riser_drag_area"}));
  EXPECT_EQ(names(testing::wedge_drop), Names{});
}

class BadLineIsRefused : public ::testing::TestWithParam<Mistake> {};

TEST_P(BadLineIsRefused, with_place_key_and_rule) {
  const auto& bad = GetParam();
  testing::expect_refused(with(bad.from, bad.to), bad);
}

const std::vector<Mistake> bad_lines = {
    {"longer_than_the_tank", "length = 0.9", "length = 90", 30, "line.riser.length = 90", "could never be taut"},
    {"without_length", "length = 0.9\n", "", 26, "line.riser.length is missing", "length of the slack line"},
    {"without_an_end", "anchor = [0, 1]\n", "", 26, "line.riser", "tied to nothing"},
    {"with_two_ends", "anchor = [0, 1]", "anchor = [0, 1]\ncanopy = {position = [0, 1], mass = 1, drag_area = 5}", 26,
     "line.riser", "a line has two ends"},
    {"without_stiffness", "stiffness = 1e4\n", "", 26, "line.riser", "Use exactly one of stiffness"},
    {"with_two_stiffnesses", "stiffness = 1e4", "stiffness = 1e4\naxial_stiffness = 1e4", 26, "line.riser",
     "Use exactly one of stiffness"},
    {"that_pushes", "stiffness = 1e4", "stiffness = -1", 31, "line.riser.stiffness = -1", "must be positive"},
    {"of_no_body", "body = \"wedge\"\nanchor", "body = \"wegde\"\nanchor", 28, "line.riser.body = \"wegde\"",
     "Did you mean 'wedge'?"},
    {"to_itself", "anchor = [0, 1]", "other = \"wedge\"\nother_point = [0, 0.1]", 29, "line.riser.other = \"wedge\"",
     "cannot be tied to itself"},
    {"heavy_without_stretch", "stiffness = 1e4", "catenary = {weight = 10}", 26,
     "line.riser.axial_stiffness is missing", "stretches"},
    {"below_its_floor", "stiffness = 1e4", "axial_stiffness = 1e4\ncatenary = {weight = 10}", 29,
     "line.riser.anchor = [0, 1]", "must not lie above"},
    {"released_by_nothing", "stiffness = 1e4", "stiffness = 1e4\nrelease = {}", 32, "line.riser.release",
     "nothing is said that releases"},
    {"released_by_less_than_nothing", "stiffness = 1e4", "stiffness = 1e4\nrelease = {load = -1}", 32,
     "line.riser.release.load = -1", "must be positive"},
    {"canopy_without_mass", "anchor = [0, 1]", "canopy = {position = [0, 1], drag_area = 5}", 29,
     "line.riser.canopy.mass is missing", "mass of cloth"},
    {"twice", "[output]",
     "[[line]]\nname = \"riser\"\nbody = \"wedge\"\nanchor = [0, 1]\nlength = 1\nstiffness = 1\n[output]", 33,
     "line[1].name = \"riser\"", "another line has this name"},
};
INSTANTIATE_TEST_SUITE_P(Lines, BadLineIsRefused, ::testing::ValuesIn(bad_lines),
                         [](const auto& line) { return std::string(line.param.name); });

TEST(Lines, that_may_not_be_meant_are_asked_about) {
  const auto asked = [](const std::string& text) {
    const auto scene = lines_scene(text);
    std::vector<std::string> of_lines;
    for (const auto& question : questions<2>(scene, predicted_cost<2>(scene)))
      if (question.starts_with("line.")) of_lines.push_back(question);
    return of_lines;
  };
  EXPECT_EQ(asked(wedge_on_riser).size(), 0u);
  EXPECT_TRUE(asked(with("length = 0.9", "length = 0.5")).at(0).starts_with("line.riser.length = 0.5 m"));
  EXPECT_TRUE(asked(with("anchor = [0, 1]\nlength = 0.9", "anchor = [9, 0]\nlength = 9"))
                  .at(0)
                  .starts_with("line.riser.anchor lies outside the tank"));
  EXPECT_TRUE(asked(with("anchor = [0, 1]\nlength = 0.9\nstiffness = 1e4",
                         "anchor = [0, -0.5]\nlength = 0.9\naxial_stiffness = 1e4\ncatenary = {weight = 10}"))
                  .at(0)
                  .starts_with("line.riser.anchor stands on a floor at -0.5 m, the tank's is at -1 m"));
}

}  // namespace
}  // namespace splashdown::apps::lines_test
