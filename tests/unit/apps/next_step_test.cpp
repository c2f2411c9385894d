// The next step as a command: relative to the run that gave it, to be pasted, with the time that check says.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "apps/check/cost.hpp"
#include "apps/price/advice.hpp"
#include "apps/price/command.hpp"
#include "apps/run/expectations.hpp"
#include "apps/run/next.hpp"
#include "apps/text/shell_word.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::next_step_test {
namespace {

NextStep finer(double by) {
  NextStep step;
  step.refine = by;
  return step;
}
NextStep longer(double end) {
  NextStep step;
  step.end = end;
  return step;
}

class NextCommand : public ::testing::Test {
 protected:
  ScratchFolder folder_;
  RunOptions options_;

  /// What complete() makes of a step of the run with these options.
  std::optional<NextStep> after(NextStep step) {
    options_.scene = folder_.write("scene.toml", testing::wedge_drop);
    const auto file = read_scene(options_.scene, options_.overrides);
    step.seconds = 40;
    std::optional<NextStep> next = step;
    complete(next, options_, file.scene, 10);
    return next;
  }
  double guess(const std::vector<std::string>& set) const {
    const auto cost = predicted_cost<2>(read_scene(options_.scene, set).scene);
    return cost.seconds_to_start + cost.steps * cost.seconds_per_step;
  }
};

TEST_F(NextCommand, is_finer_than_the_run_whatever_its_refine_is_and_wherever_it_is_from) {
  for (const auto& [word, own] : {std::pair{"", 1.},
                                  {"fluid.size.refine=0.35", 0.35},
                                  {"fluid.size.refine=draft", 0.35},
                                  {"fluid.size.refine=2", 2.},
                                  {"fluid.size.refine=0.4217", 0.4217}}) {
    options_.overrides = {"body.wedge.mass=200"};
    if (*word != 0) options_.overrides.emplace_back(word);
    const auto next = after(finer(2));
    ASSERT_TRUE(next);
    EXPECT_DOUBLE_EQ(next->refine, 2 * own);
    EXPECT_EQ(next->command, fmt::format("splashdown run {} --set body.wedge.mass=200 --refine {:.3g}",
                                         options_.scene.string(), 2 * own));
    const auto refined = fmt::format("fluid.size.refine={:.3g}", 2 * own);
    EXPECT_NEAR(next->seconds / 10, guess({"body.wedge.mass=200", refined}) / guess(options_.overrides), 1e-9)
        << "told over measured is what check says of both";
  }
}

TEST_F(NextCommand, keeps_what_else_was_asked_for_and_drops_what_chose_the_mesh) {
  options_.overrides = {"body.wedge.free=[\"y\"]", "fluid.size.refine=0.5"};
  options_.out = "my runs/a";
  options_.threads = 2;
  options_.seconds = 60;
  options_.budget = 5;
  const auto next = after(finer(1.4));
  ASSERT_TRUE(next);
  EXPECT_EQ(next->command,
            fmt::format("splashdown run {} --out 'my runs/a' --set 'body.wedge.free=[\"y\"]' --threads 2 --refine 0.7",
                        options_.scene.string()));
}

TEST_F(NextCommand, shorter_steps_are_those_of_this_mesh) {
  options_.overrides = {"time.dt_max=0.01", "fluid.size.refine=0.5"};
  NextStep step;
  step.dt_max = 0.001;
  const auto next = after(step);
  ASSERT_TRUE(next);
  const std::vector<std::string> set = {"fluid.size.refine=0.5", fmt::format("time.dt_max={}", next->dt_max)};
  const auto again = read_scene(options_.scene, set);
  EXPECT_NEAR(again.scene.time.dt_max, 0.001, 1e-12);
  EXPECT_NE(next->command.find("--refine 0.5 --set time.dt_max=0.0005"), std::string::npos) << next->command;
}

TEST_F(NextCommand, finer_and_shorter_steps_are_those_of_the_new_mesh) {
  options_.overrides = {"fluid.size.refine=0.5"};
  auto step = finer(4);
  step.dt_max = 0.001;
  const auto next = after(step);
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->command.ends_with("--refine 2 --set time.dt_max=0.002")) << next->command;
  const std::vector<std::string> set = {"fluid.size.refine=2", "time.dt_max=0.002"};
  EXPECT_NEAR(read_scene(options_.scene, set).scene.time.dt_max, 0.001, 1e-12);
}

TEST_F(NextCommand, a_longer_run_goes_on_from_where_it_is) {
  const auto next = after(longer(0.04));
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->command.ends_with("--set time.end=0.04 --resume")) << next->command;
  EXPECT_DOUBLE_EQ(next->seconds, 30) << "without what was spent";
  options_.until = 0.005;
  EXPECT_TRUE(after(longer(0.01))->command.ends_with("--until 0.01 --resume"));
}

TEST(ShellWord, comes_back_as_it_was_written) {
  EXPECT_EQ(shell_word("body.a.velocity.1=-4"), "body.a.velocity.1=-4");
  EXPECT_EQ(shell_word("free=[\"y\"]"), "'free=[\"y\"]'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(Expectations, tie_bodies_that_joints_connect_whatever_is_between) {
  Scene scene;
  scene.time.end = 2;
  for (const char* name : {"a", "b", "c", "alone"}) {
    scene.bodies.emplace_back().name = name;
    scene.bodies.back().shape = CircleShape{};
  }
  const auto tie = [&](std::size_t body, std::optional<std::size_t> other) {
    auto& joint = scene.joints.emplace_back();
    joint.body = body, joint.other = other;
  };
  tie(0, 1), tie(2, 1), tie(3, {});
  const auto expected = expectations_of(scene);
  EXPECT_EQ(expected.bodies.at("a").tied, (std::vector<std::string>{"b", "c"}));
  EXPECT_TRUE(expected.bodies.at("alone").tied.empty());
  scene.bodies[3].motion = Motion::prescribed;
  EXPECT_FALSE(expectations_of(scene).bodies.at("alone").moves);
  scene.bodies[3].velocity = {0, -1, 0};
  EXPECT_TRUE(expectations_of(scene).bodies.at("alone").moves);
}

/// A list with `rungs` meshes from half the scene's own size on, of first order, with this scatter between meshes of equal size.
Price list_of(int rungs, double scatter) {
  std::vector<Rung> made;
  const auto add = [&](double refine, Role role, double value) {
    made.push_back({.spec = {refine, role},
                    .folder = "r",
                    .seconds = refine,
                    .steps = 100,
                    .node_steps = 1e4,
                    .memory_mb = 9,
                    .values = {value}});
  };
  for (const double refine : rung_refines(rungs, 1)) add(refine, Role::rung, 10 + 1 / refine);
  const double beside = rung_refines(rungs, 1)[static_cast<std::size_t>(rungs - 2)];
  for (const double sign : {-1., 1.})
    add(beside * (1 + sign * replicate_offset), Role::replicate, 10 + 1 / beside + sign * scatter);
  std::vector<std::string> notes;
  return price_of(made, {{.name = "load", .unit = "N", .counts = true, .path = "p", .measured = {}}}, 2, notes);
}

TEST(Advice, for_an_accuracy_goes_on_from_where_the_ladder_is) {
  const ScratchFolder folder;
  const AccuracyWanted wanted{folder.write("scene.toml", testing::wedge_drop), {}, 0.01, "list"};
  const auto says = [&](int rungs, double scatter, const std::string& piece) {
    const auto text = advice_for(list_of(rungs, scatter), wanted);
    EXPECT_NE(text.find(piece), std::string::npos) << text;
  };
  says(4, 0, "--accuracy 1% --out list goes on");
  says(most_rungs, 0, "--set fluid.size.refine=2 --accuracy 1% --out list_finer builds one");
  says(4, 1, "--accuracy 1% --out list makes several runs and takes their mean");
  says(most_rungs, 1, "--out list_finer builds one");  // whose meshes may be run several times
}

}  // namespace
}  // namespace splashdown::apps::next_step_test
