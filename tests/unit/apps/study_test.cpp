// Studies: how axes expand, which files are refused and how, what folders count as finished, what is
// measured.
#include "apps/study/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/study/chart.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/run.hpp"
#include "apps/study/slurm.hpp"
#include "apps/study/table.hpp"
#include "tests/unit/apps/study_scene.hpp"

namespace splashdown::apps::study_test {
namespace {

namespace fs = std::filesystem;

using testing::good_study;
using testing::StudyTest;

TEST_F(StudyTest, has_every_combination_once_with_the_last_axis_fastest) {
  const auto runs = expand(read());
  std::vector<std::string> names;
  for (const auto& run : runs) names.push_back(run.name);
  EXPECT_EQ(names, (std::vector<std::string>{"ratio-1_plain", "ratio-1_exact", "ratio-0.5_plain", "ratio-0.5_exact",
                                             "ratio-0.1_plain", "ratio-0.1_exact"}));
  EXPECT_EQ(runs[2].set, (std::vector<std::string>{"time.end=0.01", "body.wedge.mass=50.0",
                                                   "coupling.interface_term=none", "coupling.relaxation=1"}));
}

TEST(SafeComponent, is_one_harmless_folder_name_whatever_the_text) {
  EXPECT_EQ(safe_component("mass-1_plain"), "mass-1_plain") << "good names stay";
  EXPECT_EQ(safe_component("ratio-0.5+x"), "ratio-0.5+x");
  for (const auto& [text, name] : std::map<std::string, std::string>{{"", "_"},
                                                                     {".", "_."},
                                                                     {"..", "_.."},
                                                                     {"/", "_"},
                                                                     {"../x", "_.._x"},
                                                                     {"/etc/passwd", "_etc_passwd"},
                                                                     {"-rf", "_-rf"},
                                                                     {".hidden", "_.hidden"},
                                                                     {"study.csv", "study.csv_"},
                                                                     {"a.log", "a.log_"},
                                                                     {"report.html", "report.html_"},
                                                                     {"a\nb\tc\x1b[0m", "a_b_c__0m"},
                                                                     {"`x`$(y)'\"", "_x___y___"}})
    EXPECT_EQ(safe_component(text), name) << text;
  const std::string head(300, 'x');
  EXPECT_LE(safe_component(head + "1").size(), 100u);
  EXPECT_NE(safe_component(head + "1"), safe_component(head + "2"));
}

TEST_F(StudyTest, folders_have_names_of_their_own_without_surprises_for_a_shell) {
  auto text = good_study;
  text = testing::replaced(text, "\"plain\"", "\"a b\"");
  text = testing::replaced(text, "\"exact\"\nset", "\"a/b\"\nset");
  text = testing::replaced(text, "{scheme = \"exact\"}", "{scheme = \"a b\"}");
  std::set<std::string> names;
  for (const auto& run : expand(read(text))) {
    EXPECT_EQ(run.name.find_first_of(" /"), std::string::npos) << run.name;
    names.insert(run.name);
  }
  EXPECT_EQ(names.size(), 6u);
}

TEST_F(StudyTest, reference_run_shares_all_other_axes) {
  const auto study = read();
  const auto runs = expand(study);
  for (std::size_t i = 0; i < runs.size(); ++i)
    EXPECT_EQ(reference_run(study, study.quantities[0], runs[i]), i / 2 * 2 + 1);
}

TEST_F(StudyTest, runs_count_by_what_their_folders_say) {
  using enum Outcome::Status;
  const auto study = read();
  const auto runs = resolved(study);
  const auto status = [&](const StudyRun& run) { return outcome_of(study, run, path() / run.name).status; };
  EXPECT_EQ(status(runs[0]), waiting);
  const std::vector<std::tuple<const char*, const char*, Outcome::Status>> ends = {
      {"done", "", converged},
      {"failed", "the coupling diverged: residual 3", diverged},
      {"failed", "the coupling did not converge: residual 3", stalled},
      {"failed", "the time-step criterion gives dt = 0 s", failed},
      {"interrupted", "SIGTERM", interrupted},
      {"interrupted", "the budget of 30 s is spent", stalled}};  // 31 s were
  for (const auto& [word, cause, expected] : ends) {
    leave(runs[0], word, cause, 1);
    EXPECT_EQ(status(runs[0]), expected) << word << " " << cause;
  }
  auto more_patient = study;
  more_patient.budget = 60;
  EXPECT_EQ(outcome_of(more_patient, runs[0], path() / runs[0].name).status, interrupted) << "it may go on";
}

TEST_F(StudyTest, a_folder_of_another_scene_is_no_run_of_this_one) {
  const auto study = read();
  const auto runs = resolved(study);
  leave(runs[0], "done", "", 1);
  auto changed = good_study;
  changed.replace(changed.find("0.01"), 4, "0.02");
  const auto now = resolved(read(changed));
  EXPECT_EQ(outcome_of(study, now[0], path() / now[0].name).status, Outcome::Status::waiting);
  prepare(runs[0], path() / runs[0].name);
  EXPECT_TRUE(fs::exists(path() / runs[0].name / "summary.json")) << "its own scene: kept";
  EXPECT_THROW(prepare(now[0], path() / now[0].name), std::runtime_error) << "no study made that folder";
  EXPECT_TRUE(fs::exists(path() / now[0].name / "summary.json"));
  EXPECT_EQ(foreign_places(now, path()).size(), 1u);
  write(fs::path(now[0].name) / ".splashdown-study", "");
  EXPECT_TRUE(foreign_places(now, path()).empty());
  prepare(now[0], path() / now[0].name);
  EXPECT_FALSE(fs::exists(path() / now[0].name / "summary.json")) << "begun anew";
  EXPECT_TRUE(fs::exists(path() / now[0].name / ".splashdown-study"));
}

TEST_F(StudyTest, quantities_are_measured_and_held_against_runs_and_expressions) {
  const auto study = read();
  const auto runs = resolved(study);
  leave(runs[0], "done", "", 5);  // ratio 1, plain
  leave(runs[1], "done", "", 4);  // ratio 1, exact: the reference
  leave(runs[2], "failed", "the coupling diverged: so", 9);
  std::vector<Outcome> outcomes;
  for (const auto& run : runs) outcomes.push_back(outcome_of(study, run, path() / run.name));
  EXPECT_TRUE(measure(study, runs, path(), outcomes).empty());
  EXPECT_DOUBLE_EQ(outcomes[0].numbers.at("speed"), 5);
  EXPECT_DOUBLE_EQ(outcomes[0].numbers.at("speed_error"), 0.25);
  EXPECT_DOUBLE_EQ(outcomes[1].numbers.at("speed_error"), 0);
  // |5/9.81 - 1| / (2 * 9.81)
  EXPECT_DOUBLE_EQ(outcomes[0].numbers.at("fall_error"), std::abs(5 / 9.81 - 1) / (2 * 9.81));
  EXPECT_DOUBLE_EQ(outcomes[2].numbers.at("passes_mean"), 3.5);
  EXPECT_FALSE(outcomes[2].numbers.contains("speed")) << "a run that broke down has no final state";

  write_tables(study, runs, outcomes, path());
  std::ifstream csv(path() / "study.csv");
  std::string header, first;
  std::getline(csv, header);
  std::getline(csv, first);
  EXPECT_EQ(
      header,
      "run,ratio,scheme,status,verdict,passes_mean,passes_max,rejected_steps,steps,simulated_time,wall_seconds,speed,"
      "speed_error,fall,fall_error,cause");
  EXPECT_TRUE(first.starts_with("ratio-1_plain,1,plain,converged,,3.5,,,,,31,5,0.25,")) << first;
}

TEST_F(StudyTest, a_run_whose_error_exceeds_its_limit_has_diverged) {
  auto text = good_study;
  text = testing::replaced(text, "scale = \"2*g\"", "limit = 0.6");
  const auto study = read(text);
  const auto runs = resolved(study);
  leave(runs[0], "done", "", 3.9);  // ratio 1: |3.9/9.81 - 1| = 0.602
  leave(runs[1], "done", "", 4);    // 0.592
  std::vector<Outcome> outcomes;
  for (const auto& run : runs) outcomes.push_back(outcome_of(study, run, path() / run.name));
  EXPECT_TRUE(measure(study, runs, path(), outcomes).empty());
  EXPECT_EQ(outcomes[0].status, Outcome::Status::diverged);
  EXPECT_EQ(outcomes[0].cause, "fall_error = 0.602 exceeds 0.6");
  EXPECT_EQ(outcomes[1].status, Outcome::Status::converged);
}

TEST_F(StudyTest, a_quantity_without_a_value_is_told_once) {
  auto text = good_study;
  text = testing::replaced(text, "last(vy)", "last(vz)");
  const auto study = read(text);
  const auto runs = resolved(study);
  leave(runs[0], "done", "", 5);
  leave(runs[1], "done", "", 5);
  std::vector<Outcome> outcomes;
  for (const auto& run : runs) outcomes.push_back(outcome_of(study, run, path() / run.name));
  const auto notes = measure(study, runs, path(), outcomes);
  ASSERT_EQ(notes.size(), 2u) << "speed, and fall which uses it";
  EXPECT_NE(notes[0].find("unknown name 'vz'"), std::string::npos) << notes[0];
}

TEST_F(StudyTest, answers_to_limits_have_a_column_each) {
  const auto study = read();
  const auto runs = expand(study);
  std::vector<Outcome> outcomes(runs.size());
  outcomes[0].limits = {{"belly", "yes"}, {"seat", "within the band"}};
  outcomes[1].limits = {{"belly", "no"}};
  write_tables(study, runs, outcomes, path());
  const auto csv = text("study.csv");
  EXPECT_NE(csv.find(",limit.belly,limit.seat,cause\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",yes,within the band,\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",no,,\n"), std::string::npos) << csv;
  EXPECT_NE(text("study.json").find("\"belly\": \"no\""), std::string::npos);
}

TEST_F(StudyTest, a_legend_of_numbers_says_what_they_are) {
  const auto study =
      read(testing::replaced(good_study, "x = \"ratio\"\nseries = \"scheme\"\ny = [\"passes_mean\", \"speed_error\"]",
                             "x = \"ratio\"\nseries = \"ratio\""));
  const auto runs = expand(study);
  const auto script = chart_script(study, runs, std::vector<Outcome>(runs.size()));
  EXPECT_NE(script.find("ratio = 0.5"), std::string::npos) << script;
  const auto words = chart_script(read(), runs, std::vector<Outcome>(runs.size()));
  EXPECT_NE(words.find("plain"), std::string::npos);
  EXPECT_EQ(words.find("scheme = plain"), std::string::npos);
}

// Schemes have no distance between each other: dots above their words, in the order of the file, and no lines.
TEST_F(StudyTest, an_axis_of_words_is_charted_by_dots_above_them) {
  const auto study =
      read(testing::replaced(good_study, "x = \"ratio\"\nseries = \"scheme\"", "x = \"scheme\"\nseries = \"ratio\""));
  EXPECT_FALSE(study.chart->log_x);
  const auto runs = expand(study);
  std::vector<Outcome> outcomes(runs.size());
  for (auto& outcome : outcomes) {
    outcome.status = Outcome::Status::converged;
    outcome.numbers["passes_mean"] = 3;
  }
  const auto script = chart_script(study, runs, outcomes);
  EXPECT_NE(script.find("'plain' 1, 'exact' 2"), std::string::npos) << script;
  EXPECT_NE(script.find("set xrange [0.5:2.5]"), std::string::npos);
  EXPECT_NE(script.find("with points"), std::string::npos);
  EXPECT_EQ(script.find("using 1:2 with linespoints"), std::string::npos);
}

TEST_F(StudyTest, slurm_gets_one_task_a_run_that_is_not_finished) {
  const auto study = read();
  const auto runs = resolved(study);
  leave(runs[1], "done", "", 5);
  std::vector<Outcome> outcomes;
  for (const auto& run : runs) outcomes.push_back(outcome_of(study, run, path() / run.name));
  const auto scripts = slurm_scripts(study, runs, outcomes, path(), {.at_a_time = 3, .longest = 1001});
  ASSERT_EQ(scripts.size(), 1u);
  const auto& script = scripts[0];
  EXPECT_NE(script.find("#SBATCH --array=0-4%3\n"), std::string::npos) << script;
  EXPECT_EQ(script.find("ratio-1_exact"), std::string::npos) << "is finished";
  EXPECT_NE(script.find("  1) exec "), std::string::npos);
  EXPECT_NE(script.find("'--resume'"), std::string::npos);
}

TEST_F(StudyTest, slurm_gets_several_arrays_if_one_would_be_too_long) {
  const auto study = read();
  const auto runs = resolved(study);
  ASSERT_EQ(runs.size(), 6u);
  const auto scripts = slurm_scripts(study, runs, std::vector<Outcome>(6), path(), {.at_a_time = 3, .longest = 4});
  ASSERT_EQ(scripts.size(), 2u);
  EXPECT_NE(scripts[0].find("#SBATCH --array=0-3%3\n"), std::string::npos) << scripts[0];
  EXPECT_NE(scripts[1].find("#SBATCH --array=0-1%3\n"), std::string::npos) << scripts[1];
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(scripts[k].find("/" + runs[i].name + "'") != std::string::npos, k == i / 4) << runs[i].name;
}

TEST_F(StudyTest, time_left_never_grows_while_a_run_is_waited_for) {
  EXPECT_DOUBLE_EQ(study_time_left(10, 4, 0), 40);
  double before = 40;
  for (double since = 0; since < 100; since += 0.5) {
    EXPECT_LE(study_time_left(10, 4, since), before);
    before = study_time_left(10, 4, since);
  }
  EXPECT_DOUBLE_EQ(before, 30) << "the run that is due, and three others";
  EXPECT_DOUBLE_EQ(study_time_left(10, 1, 50), 0);
}

TEST_F(StudyTest, of_a_billion_combinations_is_refused_at_once) {
  std::string values, axes;
  for (int i = 0; i < 1000; ++i) values += (i ? ", " : "") + std::to_string(i + 1);
  for (const char* name : {"a", "b", "c"})
    axes += std::string("[[axis]]\nname = \"") + name + "\"\nkey = \"body.wedge.mass\"\nvalues = [" + values + "]\n";
  const auto messages = messages_of("scene = \"scene.toml\"\n" + axes);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(
      messages[0].find("axis: 1e+09 combinations (1000 of a, 1000 of b, 1000 of c), more than 10000 runs. Use fewer "
                       "values, or several studies."),
      std::string::npos)
      << messages[0];
}

TEST_F(StudyTest, zipped_axes_vary_together) {
  auto text = testing::replaced(good_study, "[[quantity]]\nname = \"speed\"",
                                "[[axis]]\nname = \"size\"\nkey = \"body.wedge.size\"\nzip = \"ratio\"\n"
                                "values = [0.005, 0.006, 0.007]\n[[quantity]]\nname = \"speed\"");
  const auto study = read(text);
  const auto runs = expand(study);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[0].name, "ratio-1_plain_size-0.005");
  EXPECT_EQ(runs[5].name, "ratio-0.1_exact_size-0.007");
  for (const auto& run : runs) EXPECT_EQ(run.value[0], run.value[2]) << run.name;
  for (std::size_t i = 0; i < runs.size(); ++i)
    EXPECT_EQ(reference_run(study, study.quantities[0], runs[i]), i / 2 * 2 + 1);
  EXPECT_TRUE(messages_of(text).empty()) << ::testing::PrintToString(messages_of(text));
}

const std::string sampled_study = R"toml(scene = "scene.toml"
[samples]
number = 8
seed = 3
[[axis]]
name = "speed"
key = "body.wedge.velocity.1"
range = [-8, -2]
[[axis]]
name = "scheme"
[[axis.case]]
name = "plain"
set = ["coupling.relaxation=1"]
[[axis.case]]
name = "half"
set = ["coupling.relaxation=0.5"]
[[axis]]
name = "mass"
key = "body.wedge.mass"
range = [10, 1000]
spacing = "log"
)toml";

TEST_F(StudyTest, random_axes_are_a_latin_hypercube) {
  const auto study = read(sampled_study);
  const auto runs = expand(study);
  ASSERT_EQ(runs.size(), 16u) << "eight combinations with each of two cases";
  std::set<int> speeds, masses;
  for (const auto& value : study.axes[0].values) speeds.insert(static_cast<int>((*value.number + 8) / 6 * 8));
  for (const auto& value : study.axes[2].values)
    masses.insert(static_cast<int>(std::log10(*value.number / 10) / 2 * 8));
  EXPECT_EQ(speeds, (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7})) << "one in each eighth of the range";
  EXPECT_EQ(masses, speeds);
  for (const auto& run : runs) EXPECT_EQ(run.value[0], run.value[2]);
  const auto plan = plan_study(write("study.toml", sampled_study));
  ASSERT_EQ(plan.runs.size(), runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(plan.runs[i].name, runs[i].name);
  EXPECT_TRUE(messages_of(sampled_study).empty()) << ::testing::PrintToString(messages_of(sampled_study));
}

TEST_F(StudyTest, a_seed_draws_the_same_values_whatever_stands_beside_them) {
  const auto values = [&](const std::string& text, std::size_t axis) {
    std::vector<std::string> texts;
    const auto study = read(text);
    for (const auto& value : study.axes[axis].values) texts.push_back(value.text);
    return texts;
  };
  auto alone = sampled_study;
  alone.erase(alone.find("[[axis]]\nname = \"speed\""),
              alone.find("[[axis]]\nname = \"scheme\"") - alone.find("[[axis]]\nname = \"speed\""));
  EXPECT_EQ(values(alone, 1), values(sampled_study, 2));
  EXPECT_NE(values(testing::replaced(sampled_study, "seed = 3", "seed = 4"), 0), values(sampled_study, 0));
  EXPECT_NE(values(sampled_study, 0), values(sampled_study, 2));
  // Portable: nothing of it depends on the machine's library.
  EXPECT_EQ(values(sampled_study, 0).front(), "-5.45583");
}

TEST_F(StudyTest, until_stops_runs_and_a_later_one_lets_them_go_on) {
  const auto short_study = read(testing::replaced(good_study, "budget = 30", "until = 0.004"));
  const auto runs = resolved(short_study);
  EXPECT_EQ(runs[0].stop, 0.004);
  const auto command = command_of(short_study, runs[0], path());
  const auto until = std::ranges::find(command, "--until");
  ASSERT_NE(until, command.end());
  EXPECT_EQ(*(until + 1), "0.004");
  leave(runs[0], "done", "", 1);
  write(fs::path(runs[0].name) / "summary.json", R"({"status": "done", "simulated_time": 0.004})");
  EXPECT_EQ(outcome_of(short_study, runs[0], path() / runs[0].name).status, Outcome::Status::converged);
  const auto study = read(testing::replaced(good_study, "budget = 30\n", ""));
  const auto whole = resolved(study);
  EXPECT_EQ(outcome_of(study, whole[0], path() / whole[0].name).status, Outcome::Status::interrupted) << "it goes on";
}

}  // namespace
}  // namespace splashdown::apps::study_test
