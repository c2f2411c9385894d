// Mistakes in studies are told with place, key and rule.

#include "tests/unit/apps/study_scene.hpp"

namespace splashdown::apps::study_mistakes_test {
namespace {

using testing::good_study;
using testing::StudyTest;

TEST_F(StudyTest, all_mistakes_are_told_at_once_before_any_run) {
  auto text = testing::replaced(good_study, "budget = 30", "budgte = 30");
  text = testing::replaced(text, "body.wedge.mass", "body.wegde.mass");
  text = testing::replaced(text, "interface_term=none", "interface_term=non");
  text = testing::replaced(text, "\"speed/g\"", "\"summary.bodies.wegde.peak_force.value\"");
  const auto messages = messages_of(text);
  ASSERT_EQ(messages.size(), 4u) << ::testing::PrintToString(messages);
  EXPECT_NE(messages[0].find(":4: budgte = 30: unknown key. Did you mean 'budget'?"), std::string::npos) << messages[0];
  EXPECT_NE(messages[1].find(":11: axis.ratio: body.wegde.mass=100.0: no body is called 'wegde'"), std::string::npos)
      << messages[1];
  EXPECT_NE(messages[2].find(":15: axis.scheme: coupling.interface_term=non"), std::string::npos) << messages[2];
  EXPECT_NE(
      messages[3].find(":27: quantity.fall.quantity = \"summary.bodies.wegde.peak_force.value\": runs of this scene "
                       "have no 'summary.bodies.wegde'. Did you mean 'wedge'?"),
      std::string::npos)
      << messages[3];
}

TEST_F(StudyTest, quantities_may_use_every_entry_that_a_run_can_have) {
  for (const char* good :
       {"summary.bodies.wedge.peak_acceleration_g.raw.value", "summary.bodies.wedge.peak_acceleration_g.cfc60.delta_v",
        "summary.bodies.wedge.peak_force_filtered.cfc180.impulse", "summary.bodies.wedge.impulse.1",
        "summary.bodies.wedge.attitude_deg.pitch.maximum.time", "summary.bodies.wedge.dry_intervals.0.1",
        "summary.ledger.energy_gain", "summary.coupling.passes_mean", "summary.phases.pressure", "summary.nodes.max",
        "passes_mean", "ratio", "g", "vy", "summary.bodies.wedge.settled_time", "summary.bodies.wedge.capsized"}) {
    const auto messages = messages_of(testing::replaced(good_study, "last(vy)", std::string("last(vy) + ") + good));
    EXPECT_TRUE(messages.empty()) << good << ": " << ::testing::PrintToString(messages);
  }
}

TEST_F(StudyTest, without_axes_has_no_mistake_in_its_chart) {
  const auto messages = messages_of("scene = \"scene.toml\"\n[chart]\nx = \"ratio\"\n");
  ASSERT_EQ(messages.size(), 1u) << ::testing::PrintToString(messages);
  EXPECT_NE(messages[0].find("axis is missing"), std::string::npos) << messages[0];
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
    {"until_beyond_the_end", "budget = 30", "until = 1", 4,
     "until = 1: must not exceed time.end = 0.01 s of ratio-1_plain", "Use set = "},
    {"range_without_samples", "scale = 100\nvalues = [1, 0.5, 0.1]", "range = [1, 2]", 10, "axis.ratio.range = [1, 2]",
     "needs [samples], which says how many values are drawn"},
    {"range_upside_down", "scale = 100\nvalues = [1, 0.5, 0.1]", "range = [2, 1]", 10, "axis.ratio.range = [2, 1]",
     "the lower one first"},
    {"samples_without_a_number", "[constants]", "[samples]\nseed = 2\n[constants]", 5, "samples.number is missing",
     "Use e.g. 20"},
    {"zip_of_other_length", "name = \"scheme\"\n", "name = \"scheme\"\nzip = \"ratio\"\n", 14,
     "axis.scheme.zip = \"ratio\"", "this axis has 2 values, ratio has 3"},
    {"zip_with_no_axis", "scale = 100", "zip = \"scheme\"", 10, "axis.ratio.zip", "no axis before this one"},
    {"unknown_column", "last(vy)", "last(vv)", 22, "quantity.speed.quantity = \"last(vv)\": unknown name 'vv'",
     "Did you mean"},
    {"table_of_no_body", "bodies.csv:wedge", "bodies.csv:wegde", 22, "quantity.speed.table = \"bodies.csv:wegde\"",
     "Did you mean 'wedge'?"},
    {"table_that_no_run_writes", "bodies.csv:wedge", "bodie.csv:wedge", 22,
     "quantity.speed.table = \"bodie.csv:wedge\"", "no run writes 'bodie.csv'. Did you mean 'bodies.csv'?"},
    {"distribution_as_a_word", "scale = 100\nvalues = [1, 0.5, 0.1]", "distribution = \"normal\"", 10,
     "axis.ratio.distribution = \"normal\"", "Write e.g. distribution = {type = \"normal\""},
    {"bounds_at_an_axis", "scale = 100\nvalues = [1, 0.5, 0.1]", "min = 1\nmax = 2", 10, "axis.ratio.min",
     "Use range = [1, 5]"},
    {"numbers_for_a_list", "body.wedge.mass", "body.wedge.velocity", 11, "axis.ratio: body.wedge.velocity=100.0: ",
     "An axis of numbers sets one of its entries: key = \"body.wedge.velocity.0\""},
    {"group_without_axes", "[chart]", "[[group]]\n[chart]", 30, "group[0].by is missing", "by = [\"mass\"]"},
    {"group_of_no_axis", "[chart]", "[[group]]\nby = [\"rato\"]\n[chart]", 31, "group[0].by = [\"rato\"]", "'ratio'"},
    {"summary_without_such_an_entry", "last(vy)", "summary.coupling.passes", 22,
     "quantity.speed.quantity = \"summary.coupling.passes\": runs of this scene have no 'summary.coupling.passes'",
     "Did you mean 'passes_max'?"},
    {"summary_entry_that_is_no_number", "last(vy)", "summary.bodies.wedge.peak_force", 22, "quantity.speed.quantity",
     "Use one of its entries: 'begin', 'duration', 'impulse'"},
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
}  // namespace splashdown::apps::study_mistakes_test
