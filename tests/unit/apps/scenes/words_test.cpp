// Texts for people: units with sensible digits, progress, characteristic numbers, folder names.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "apps/check/cost.hpp"
#include "apps/process/exit.hpp"
#include "apps/run/closing.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/run/progress.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/scene/scales.hpp"
#include "apps/statistics/verdict/verdict.hpp"
#include "apps/text/number_text.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::words_test {
namespace {

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

TEST(Words, values_carry_a_metric_prefix) {
  EXPECT_EQ(with_unit(26745.8, "N/m"), "26.75 kN/m");
  EXPECT_EQ(with_unit(0.014872, "s"), "14.87 ms");
  EXPECT_EQ(with_unit(-3e6, "Pa"), "-3 MPa");
  EXPECT_EQ(with_unit(0, "s"), "0 s");
  EXPECT_EQ(with_unit(0.99999, "s"), "1 s");
  EXPECT_EQ(with_unit(1e-12, "s"), "1e-12 s");
}

TEST(Words, a_run_closes_with_its_verdict_in_red_on_a_terminal) {
  Summary summary;
  summary.scene = "drop";
  summary.status = "done";
  summary.nodes = RangeCount{10, 30, 20};
  auto& ledger = summary.ledger.emplace();
  ledger.volume_error = 1e-4;
  ledger.volume_error_bodies = 0.011;
  ledger.energy_gain = 0.34;
  ledger.energy_scale = 2000;
  judge(summary);
  const auto plain = closing_text(summary, "nowhere");
  for (const auto* piece :
       {"20 nodes (30 at most), volume error 0.01 % (1.1 % of the hulls), energy gain 34 % of 2 kJ/m",
        "verdict     unphysical\n              trust: the water's volume\n",
        "doubt: the water's energy (34 % of what was exchanged came from nowhere)\n",
        "do:    ", "because     The water gained", "from nowhere", "time.cfl"})
    EXPECT_NE(plain.find(piece), std::string::npos) << piece << " is not in: " << plain;
  EXPECT_EQ(plain.find('\x1b'), std::string::npos);
  const auto colour = [&] { return closing_text(summary, "nowhere", Ink::colour); };
  EXPECT_NE(colour().find("\x1b[1;31munphysical\x1b[0m"), std::string::npos);
  summary.ledger->energy_gain = 0.03;
  judge(summary);
  EXPECT_NE(colour().find("\x1b[1;33mdoubtful\x1b[0m"), std::string::npos);
  summary.ledger->energy_gain = 0;
  judge(summary);
  EXPECT_NE(colour().find("\x1b[32mresolved\x1b[0m"), std::string::npos);
  auto& fluid = summary.fluid.emplace();
  for (const auto& [count, text] : {std::pair{0L, "(30 at most), volume"},
                                    {1L, "(30 at most), 1 new mesh, volume"},
                                    {6L, "(30 at most), 6 new meshes, volume"}}) {
    fluid.remeshings = count;
    EXPECT_NE(closing_text(summary, "nowhere").find(text), std::string::npos) << text;
  }
}

TEST(Words, a_repair_share_is_one_of_what_is_left_of_the_impulse) {
  Summary summary;
  auto& body = summary.bodies["hull"];
  body.landing.first_contact = 0.01;
  body.impulse = {0, 3};
  for (const auto& [repair, to_and_fro, text] : {std::tuple{3.6, 4., "no meaningful repair share"},
                                                 {0.0372, 4., "repair share of the impulse 1.2 %"},
                                                 {0.75, 4., "repair share of the impulse 25 %"},
                                                 {0.75, 400., "no meaningful repair share"}}) {
    body.impulse_repair = {0, repair}, body.impulse_to_and_fro = to_and_fro;
    EXPECT_NE(closing_text(summary, "nowhere").find(text), std::string::npos) << closing_text(summary, "nowhere");
  }
}

TEST(Words, a_wall_time_that_nobody_waits_for_is_in_days) {
  EXPECT_EQ(clock_text(99 * 86400), "2376:00:00");
  EXPECT_EQ(clock_text(4e9), "4.6e+04 days");
  EXPECT_EQ(clock_text(INFINITY), "inf days");
}

TEST(Words, progress_says_where_the_run_is) {
  EXPECT_EQ(clock_text(7.4), "0:07");
  EXPECT_EQ(clock_text(750), "12:30");
  EXPECT_EQ(clock_text(11100), "3:05:00");
  const ProgressPoint point{.time = 0.005, .stop = 0.02, .dt = 1e-4, .steps = 50, .nodes = 1234, .passes = 2};
  const auto text = progress_text(point, 61);
  for (const auto* piece :
       {" 25 %", "t = 0.005 of 0.02 s", "step 50", "dt 0.0001 s", "nodes 1234", "passes 2", "left 1:01"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << " is not in: " << text;
  EXPECT_EQ(progress_text({.time = 0, .stop = 1, .dt = 1, .steps = 0, .nodes = {}, .passes = {}}, -1).find("nodes"),
            std::string::npos);
}

TEST(Words, a_run_is_named_after_its_folder_or_its_file) {
  EXPECT_EQ(default_directory("examples/wedge_drop/scene.toml"), "out/wedge_drop");
  EXPECT_EQ(default_directory("examples/ladder/study.toml"), "out/ladder");
  EXPECT_EQ(default_directory("examples/cone_entry/scene_45.toml"), "out/cone_entry_scene_45");
  EXPECT_EQ(default_directory("examples/wedge_entry/scene_45.toml"), "out/wedge_entry_scene_45");
  EXPECT_EQ(default_directory("examples/wedge_drop/wedge_drop.toml"), "out/wedge_drop") << "said once is enough";
  EXPECT_EQ(default_directory("examples/wedge_drop/wedge_drop_light.toml"), "out/wedge_drop_light");
  EXPECT_EQ(default_directory("light.toml"), "out/light") << "in the folder where out/ is";
}

TEST(ForeignResults, are_those_of_another_scene_or_a_study) {
  const ScratchFolder scratch;
  const auto folder = scratch.path() / "run", one = scratch.write("a/scene.toml", ""),
             other = scratch.write("b/scene.toml", "");
  const std::string resolved = "title = \"one\"\n", changed = "title = \"one\"\nx = 1\n",
                    different = "title = \"two\"\n";
  EXPECT_FALSE(foreign_results(folder, one, resolved)) << "nothing is there";
  scratch.write("mine/notes.txt", "");
  EXPECT_FALSE(foreign_results(scratch.path() / "mine", one, resolved)) << "nothing that a run would replace";
  scratch.write("mine/checkpoint/weights", "");
  EXPECT_NE(foreign_results(scratch.path() / "mine", one, resolved)
                .value_or("")
                .find("mine holds checkpoint, which would "
                      "be replaced, but no scene.resolved"),
            std::string::npos);
  scratch.write("run/summary.json", "{}");
  write_resolved(folder, one, resolved);
  EXPECT_FALSE(foreign_results(folder, one, resolved));
  EXPECT_FALSE(foreign_results(folder, one, changed)) << "the same file with other values";
  EXPECT_FALSE(foreign_results(folder, other, resolved)) << "the same scene from another place";
  EXPECT_FALSE(foreign_results(folder, scratch.path() / "a" / ".." / "a" / "scene.toml", changed));
  const auto message = foreign_results(folder, other, different).value_or("");
  for (const auto* piece : {"holds the results of another scene, 'one' (", "a/scene.toml)", "this one is 'two' (",
                            "b/scene.toml)", "Use --out with another folder, or --force to replace it."})
    EXPECT_NE(message.find(piece), std::string::npos) << piece << " is not in: " << message;
  std::filesystem::remove(folder / "summary.json");
  EXPECT_FALSE(foreign_results(folder, other, different)) << "it was never begun";
  scratch.write("run/checkpoint/state", "x");
  EXPECT_TRUE(foreign_results(folder, other, different)) << "one that waits to be continued counts";
  scratch.write("run/study.json", "{}");
  EXPECT_NE(foreign_results(folder, one, resolved).value_or("").find("holds a study"), std::string::npos);
}

TEST(Scales, follow_the_fastest_thing_in_the_scene) {
  const auto falling = scales<2>(scene_of(testing::wedge_drop));
  EXPECT_DOUBLE_EQ(falling.length, 0.5);
  EXPECT_DOUBLE_EQ(falling.speed, std::sqrt(6.15 * 6.15 + 2 * 9.81 * 0.01));
  const auto resting = scales<2>(
      scene_of(testing::wedge_drop_with("position = [0, 0.01]\nvelocity = [0, -6.15]", "position = [0, -0.01]")));
  EXPECT_DOUBLE_EQ(resting.speed, std::sqrt(9.81 * 0.5));
}

TEST(Scales, every_effect_is_on_or_off_with_a_number) {
  const auto notes = effect_notes<2>(scene_of(testing::wedge_drop));
  ASSERT_GE(notes.size(), 3u);
  EXPECT_TRUE(notes[0].active);
  EXPECT_NE(notes[0].reason.find("Fr = U/sqrt(g L) = 2.78"), std::string::npos) << notes[0].reason;
  EXPECT_FALSE(notes[1].active);
  EXPECT_NE(notes[1].reason.find("Re = rho U L/mu = 3.08e+06"), std::string::npos) << notes[1].reason;
  for (std::size_t i = 2; i < notes.size(); ++i) EXPECT_FALSE(notes[i].active) << notes[i].name;
}

TEST(Cost, counts_the_nodes_of_a_uniform_box) {
  const auto scene = scene_of(testing::wedge_drop_with("far = 0.2\n", ""));  // h = 0.01 up to the walls
  const auto coarse_body = [&] {
    auto s = scene;
    s.bodies.clear();
    return s;
  }();
  // 4 m x 1 m of equilateral triangles of side 0.01 m
  EXPECT_NEAR(predicted_cost<2>(coarse_body).nodes, 4 * 2 / (std::sqrt(3.) * 1e-4), 1);
}

TEST(Cost, finer_elements_at_the_body_cost_nodes) {
  const double coarse = predicted_cost<2>(scene_of(testing::wedge_drop)).nodes;
  const double fine = predicted_cost<2>(scene_of(testing::wedge_drop_with("size = 0.005", "size = 0.001"))).nodes;
  EXPECT_GT(fine, coarse);
  EXPECT_GT(coarse, 400);    // the surface alone: 4 m of elements of 0.01 m
  EXPECT_LT(coarse, 46000);  // all of it at 0.01 m
}

// Runs of these scenes take 97 and 82 steps: a light body is stopped while its contact lines still run, so that hardly fewer do.
// A guess is good within a quarter.
TEST(Cost, steps_of_an_impact_follow_its_contact_lines) {
  const double heavy = predicted_cost<2>(scene_of(testing::wedge_drop)).steps;
  const double light = predicted_cost<2>(scene_of(testing::wedge_drop_with("mass = 241", "mass = 24.1"))).steps;
  EXPECT_NEAR(heavy / 97, 1, 0.25);
  EXPECT_NEAR(light / 82, 1, 0.25);
}

}  // namespace
}  // namespace splashdown::apps::words_test
