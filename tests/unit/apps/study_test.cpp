// Studies: how axes expand, which files are refused and how, what folders count as finished, what is
// measured.
#include "apps/study.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/study_chart.hpp"
#include "apps/study_run.hpp"
#include "apps/study_slurm.hpp"
#include "apps/study_table.hpp"
#include "scenes.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

const std::string good_study = R"toml(title = "study"
scene = "scene.toml"
set = ["time.end=0.01"]
budget = 30
[constants]
g = 9.81
[[axis]]
name = "ratio"
key = "body.wedge.mass"
scale = 100
values = [1, 0.5, 0.1]
[[axis]]
name = "scheme"
[[axis.case]]
name = "plain"
set = ["coupling.interface_term=none", "coupling.relaxation=1"]
[[axis.case]]
name = "exact"
set = ["coupling.interface_term=rigid"]
[[quantity]]
name = "speed"
quantity = "last(vy)"
table = "bodies.csv:wedge"
reference = {scheme = "exact"}
[[quantity]]
name = "fall"
quantity = "speed/g"
exact = "ratio"
scale = "2*g"
[chart]
x = "ratio"
series = "scheme"
y = ["passes_mean", "speed_error"]
)toml";

class StudyTest : public ::testing::Test, protected ScratchFolder {
 protected:
  StudyTest() { write("scene.toml", testing::wedge_drop); }

  Study read(const std::string& text = good_study) const { return read_study(write("study.toml", text)); }
  std::vector<std::string> messages_of(const std::string& text) const {
    return testing::refusal_of([&] {
      const auto study = read(text);
      auto runs = expand(study);
      resolve(study, runs);
    });
  }
  /// What a run of this scene would leave behind.
  void leave(const StudyRun& run, const std::string& status, const std::string& cause, double speed) const {
    write(fs::path(run.name) / "scene.resolved.toml", run.resolved + "\n[provenance]\n");
    write(fs::path(run.name) / "bodies.csv", "time,body,vy\n0,wedge,0\n1,wedge," + std::to_string(speed) + "\n");
    write(fs::path(run.name) / "summary.json", R"({"status": ")" + status + R"(", "cause": ")" + cause +
                                                   R"(", "wall_seconds": 31, "coupling": {"passes_mean": 3.5}})");
  }
  std::vector<StudyRun> resolved(const Study& study) const {
    auto runs = expand(study);
    resolve(study, runs);
    return runs;
  }
};

TEST_F(StudyTest, has_every_combination_once_with_the_last_axis_fastest) {
  const auto runs = expand(read());
  std::vector<std::string> names;
  for (const auto& run : runs) names.push_back(run.name);
  EXPECT_EQ(names, (std::vector<std::string>{"ratio-1_plain", "ratio-1_exact", "ratio-0.5_plain", "ratio-0.5_exact",
                                             "ratio-0.1_plain", "ratio-0.1_exact"}));
  EXPECT_EQ(runs[2].set, (std::vector<std::string>{"time.end=0.01", "body.wedge.mass=50.0",
                                                   "coupling.interface_term=none", "coupling.relaxation=1"}));
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
  prepare(now[0], path() / now[0].name);
  EXPECT_FALSE(fs::exists(path() / now[0].name)) << "begun anew";
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
  EXPECT_EQ(header,
            "run,ratio,scheme,status,passes_mean,passes_max,rejected_steps,steps,simulated_time,wall_seconds,speed,"
            "speed_error,fall,fall_error,cause");
  EXPECT_TRUE(first.starts_with("ratio-1_plain,1,plain,converged,3.5,,,,,31,5,0.25,")) << first;
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

TEST_F(StudyTest, slurm_gets_one_task_a_run_that_is_not_finished) {
  const auto study = read();
  const auto runs = resolved(study);
  leave(runs[1], "done", "", 5);
  std::vector<Outcome> outcomes;
  for (const auto& run : runs) outcomes.push_back(outcome_of(study, run, path() / run.name));
  const auto script = slurm_script(study, runs, outcomes, path(), 3);
  EXPECT_NE(script.find("#SBATCH --array=0-4%3\n"), std::string::npos) << script;
  EXPECT_EQ(script.find("ratio-1_exact"), std::string::npos) << "is finished";
  EXPECT_NE(script.find("  1) exec "), std::string::npos);
  EXPECT_NE(script.find("'--resume'"), std::string::npos);
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

using testing::Mistake;

class BadStudyIsRefused : public StudyTest, public ::testing::WithParamInterface<Mistake> {};

TEST_P(BadStudyIsRefused, with_place_key_and_rule) {
  const auto& bad = GetParam();
  const auto messages = messages_of(testing::replaced(good_study, bad.from, bad.to));
  testing::expect_told(messages, (path() / "study.toml").string(), bad);
}

const std::vector<Mistake> studies = {
    {"syntax", "budget = 30", "budget = = 30", 4, "not TOML", "toml.io"},
    {"unknown_key", "budget = 30", "budgte = 30", 4, "budgte = 30: unknown key", "Did you mean 'budget'?"},
    {"no_scene", "scene = \"scene.toml\"\n", "", 1, "scene is missing", "Name the scene file"},
    {"scene_that_is_not_there", "\"scene.toml\"", "\"none.toml\"", 2, "scene = \"none.toml\"", "no such file"},
    {"set_of_numbers", "[\"time.end=0.01\"]", "[3]", 3, "set = [3]", "must be a list of strings"},
    {"negative_budget", "budget = 30", "budget = -1", 4, "budget = -1", "must be positive (s)"},
    {"constant_as_text", "g = 9.81", "g = \"x\"", 6, "constants.g = \"x\"", "must be a number"},
    {"axis_without_name", "name = \"ratio\"\n", "", 7, "axis[0].name is missing", "Use a short word"},
    {"axis_with_a_name_for_no_expression", "\"ratio\"\nkey", "\"a ratio\"\nkey", 8, "axis.a ratio.name",
     "expressions can use"},
    {"axis_called_as_a_column", "\"ratio\"\nkey", "\"status\"\nkey", 8, "axis.status.name", "already"},
    {"axis_without_key", "key = \"body.wedge.mass\"\n", "", 7, "axis.ratio.key is missing", "as for --set"},
    {"axis_without_values", "values = [1, 0.5, 0.1]\n", "", 7, "axis.ratio.values is missing", "Use a list"},
    {"empty_values", "[1, 0.5, 0.1]", "[]", 11, "axis.ratio.values = []", "at least one value"},
    {"value_twice", "[1, 0.5, 0.1]", "[1, 0.5, 1]", 11, "axis.ratio.values", "holds 1 twice"},
    {"value_beyond_exact_integers", "[1, 0.5, 0.1]", "[9007199254740993]", 11, "axis.ratio.values", "beyond 2^53"},
    {"constant_beyond_exact_integers", "g = 9.81", "g = 9007199254740993", 6, "constants.g", "beyond 2^53"},
    {"words_with_a_scale", "[1, 0.5, 0.1]", "[\"a\"]", 11, "axis.ratio.values", "must be numbers"},
    {"key_beside_cases", "name = \"scheme\"\n", "name = \"scheme\"\nkey = \"title\"\nvalues = [\"x\"]\n", 12,
     "axis.scheme", "both"},
    {"case_twice", "\"exact\"\nset", "\"plain\"\nset", 18, "axis.scheme.case[1].name = \"plain\"", "already"},
    {"case_without_set", "set = [\"coupling.interface_term=rigid\"]\n", "", 17, "axis.scheme.case.exact.set is missing",
     "--set"},
    {"quantity_with_a_torn_expression", "last(vy)", "last(vy", 22, "quantity.speed.quantity", "expected ')'"},
    {"quantity_twice", "\"fall\"", "\"speed\"", 26, "quantity[1].name = \"speed\"", "already"},
    {"reference_at_no_axis", "{scheme = \"exact\"}", "{shceme = \"exact\"}", 24,
     "quantity.speed.reference.shceme = \"exact\": unknown key", "Did you mean 'scheme'?"},
    {"reference_at_no_value", "{scheme = \"exact\"}", "{scheme = \"best\"}", 24,
     "quantity.speed.reference.scheme = \"best\"", "Use 'plain' or 'exact'"},
    {"exact_beside_a_reference", "exact = \"ratio\"", "exact = 1\nreference = {scheme = \"exact\"}", 29,
     "quantity.fall.reference", "must not stand beside exact"},
    {"scale_of_nothing", "exact = \"ratio\"\n", "", 28, "quantity.fall.scale", "nothing to scale"},
    {"limit_of_nothing", "quantity = \"last(vy)\"\ntable = \"bodies.csv:wedge\"\nreference = {scheme = \"exact\"}",
     "quantity = \"last(vy)\"\nlimit = 1", 23, "quantity.speed.limit", "nothing to limit"},
    {"chart_of_no_axis", "x = \"ratio\"", "x = \"rato\"", 31, "chart.x = \"rato\"", "Did you mean 'ratio'?"},
    {"chart_over_words", "x = \"ratio\"", "x = \"scheme\"", 31, "chart.x = \"scheme\"", "axis of numbers"},
    {"chart_of_no_column", "\"passes_mean\"", "\"passes\"", 33, "chart.y", "'passes_mean'"},
    {"logarithm_of_zero", "[1, 0.5, 0.1]", "[1, 0.5, 0]", 31, "chart.x", "linear"},
    // What the scene's own rules say about a value, at the value's place.
    {"value_the_scene_refuses", "scale = 100", "scale = -100", 11,
     "axis.ratio: body.wedge.mass=-100.0: ", "must not be below 0"},
    {"key_the_scene_does_not_have", "body.wedge.mass", "body.wegde.mass", 11,
     "axis.ratio: body.wegde.mass=100.0: ", "Did you mean 'wedge'?"},
    {"case_the_scene_refuses", "interface_term=none", "interface_term=non", 15,
     "axis.scheme: coupling.interface_term=non: ", "Did you mean 'none'?"},
    {"set_the_scene_refuses", "time.end=0.01", "time.end=0", 1, "set: time.end=0: ", "must be positive"},
};

INSTANTIATE_TEST_SUITE_P(Table, BadStudyIsRefused, ::testing::ValuesIn(studies),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace splashdown::apps
