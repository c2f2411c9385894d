// What scenes say about their joints, and what a run says at its end about a body that never moved.
#include <gtest/gtest.h>

#include "apps/check/ties.hpp"
#include "apps/run/held.hpp"
#include "apps/statistics/verdict/verdict.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::ties_questions_test {
namespace {

const std::string box = R"([time]
end = 1
[gravity]
[tank]
min = [-8, -3]
max = [8, 2]
[fluid]
density = 1000
[[fluid.region]]
shape = "box"
min = [-8, -3]
max = [8, 0]
[[body]]
name = "float"
shape = {type = "box", width = 1.0, height = 2.0}
mass = 1000
position = [0.0, -0.5]
)";

std::string slider(const char* axis) {
  return std::string("[[joint]]\ntype = \"slider\"\nbody = \"float\"\naxis = ") + axis + "\nstiffness = 2e4\n";
}

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

TEST(Joints, that_hold_a_body_fast_are_asked_about_by_their_names) {
  const auto list = ties_questions<2>(scene_of(box + slider("[1.5, -1.5]") + slider("[-1.5, -1.5]")));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(
      list[0],
      "body.float cannot move: joint[0] (slider of 'float' to the world) and joint[1] (slider of 'float' to the world) "
      "together leave it no motion: did you mean one of them only, or motion = \"fixed\"?");
  EXPECT_TRUE(ties_questions<2>(scene_of(box + slider("[1.5, -1.5]"))).empty());
}

TEST(Joints, that_repeat_others_are_noted_unless_they_have_springs) {
  const std::string hinge = "[[joint]]\ntype = \"hinge\"\nbody = \"float\"\npoint = [0, 0]\n";
  const auto doubled = scene_of(box + hinge + hinge);
  ASSERT_EQ(ties_notes<2>(doubled).size(), 1u);
  EXPECT_TRUE(ties_notes<2>(doubled)[0].starts_with("joint[1] (hinge of 'float' to the world) holds nothing"));
  EXPECT_TRUE(ties_questions<2>(doubled).empty());
  EXPECT_TRUE(ties_notes<2>(scene_of(box + slider("[0, 1]") + slider("[0, 2]"))).empty());
}

TEST(Joints, that_contradict_each_other_are_refused_with_file_and_line) {
  const std::string posts = R"([[body]]
name = "post"
shape = {type = "box", width = 0.2, height = 0.2}
motion = "fixed"
position = [-3, 1]
[[body]]
name = "tow"
shape = {type = "box", width = 0.2, height = 0.2}
motion = "prescribed"
path = [[0, 3, 1, 0], [0.2, 3, 1, 0], [0.5, 4, 1, 0]]
)";
  const auto weld = [](const std::string& other) {
    return "[[joint]]\ntype = \"weld\"\nbody = \"float\"\nother = \"" + other + "\"\n";
  };
  const auto refusal = [](const std::string& text) {
    return testing::refusal_of([&] { refuse_contradicting_ties<2>(read_scene_text(text, "scene.toml")); });
  };
  EXPECT_TRUE(refusal(box + posts + weld("tow")).empty());
  const auto messages = refusal(box + posts + weld("post") + weld("tow"));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_TRUE(
      messages[0].starts_with("scene.toml:32: joint[1]: joint[0] (weld of 'float' to 'post') and joint[1] (weld of "
                              "'float' to 'tow') ask for motions that exclude each other"))
      << messages[0];
}

TEST(Verdict, tells_of_a_body_that_never_moved_though_something_pulled_at_it) {
  const auto scene = scene_of(box + slider("[1.5, -1.5]") + slider("[-1.5, -1.5]"));
  Summary summary;
  summary.status = "done";
  auto& body = summary.bodies["float"];
  body.landing.first_contact = 0;
  const double weight = 9810, buoyancy = 14715;
  body.impulse = {0, 2 * buoyancy};
  mark_held<2>(scene, 2, summary);
  EXPECT_NEAR(body.held_against, buoyancy - weight, 1e-9 * buoyancy);
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::doubtful);
  ASSERT_FALSE(summary.verdict.reasons.empty());
  EXPECT_TRUE(summary.verdict.reasons[0].starts_with("A free body never moved though 4.91 kN/m pulled at it: float."))
      << summary.verdict.reasons[0];

  body.held_against = 0;
  body.impulse = {0, 2 * weight};  // in balance
  mark_held<2>(scene, 2, summary);
  EXPECT_EQ(body.held_against, 0);
  body.impulse = {0, 2 * buoyancy};
  body.fastest = 1e-3;  // it moves
  mark_held<2>(scene, 2, summary);
  EXPECT_EQ(body.held_against, 0);
}

}  // namespace
}  // namespace splashdown::apps::ties_questions_test
