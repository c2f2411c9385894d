// Envelopes choose their runs near the line; keys and distributions may depend on other axes.
#include "apps/study/campaign/envelope.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/study/campaign/results.hpp"
#include "apps/study/design/shares.hpp"
#include "tests/unit/apps/study_scene.hpp"

namespace splashdown::apps::envelope_test {
namespace {

using testing::replaced;
using testing::StudyTest;

/// A plane of `number` by `number` cells with `draws` random runs each, none of them made.
struct Plane {
  Study study;
  std::vector<StudyRun> runs;
  std::vector<Outcome> outcomes;

  Plane(std::size_t number, std::size_t draws) {
    study.envelope = {.limit = "hot", .x = 0, .y = 1};
    for (const char* name : {"x", "y"}) {
      Axis axis{.name = name, .label = name, .values = {}, .leader = study.axes.size(), .product = {}};
      for (std::size_t i = 0; i < number; ++i)
        axis.values.push_back({.text = std::to_string(i), .number = double(i), .set = {}, .place = {}});
      study.axes.push_back(axis);
    }
    Axis chance{.name = "chance", .label = {}, .values = {}, .leader = 2, .sampled = draws > 1, .product = {}};
    chance.values.resize(draws);
    study.axes.push_back(chance);
    for (std::size_t x = 0; x < number; ++x)
      for (std::size_t y = 0; y < number; ++y)
        for (std::size_t k = 0; k < draws; ++k)
          runs.push_back({.name = {}, .value = {x, y, k}, .set = {}, .resolved = {}});
    outcomes.resize(runs.size());
  }
  void answer(std::size_t run, bool yes) {
    outcomes[run].status = Outcome::Status::converged;
    outcomes[run].limits["hot"] = yes ? "yes" : "no";
  }
  EnvelopePlane judged(const std::vector<std::size_t>& at_work = {}) const { return {study, runs, outcomes, at_work}; }
};

TEST(EnvelopePlane, a_line_is_found_with_a_third_of_the_runs_and_then_they_end) {
  constexpr std::size_t number = 20;
  const auto beyond = [](std::size_t x, std::size_t y) {  // two pieces: a curved line, and an island off it
    const double u = double(x) / 19, v = double(y) / 19;
    return v > 0.35 + 0.5 * u * u || std::hypot(u - 0.8, v - 0.2) < 0.17;
  };
  Plane plane(number, 1);
  int made = 0;
  while (const auto run = plane.judged().next()) {
    plane.answer(*run, beyond(plane.runs[*run].value[0], plane.runs[*run].value[1]));
    ASSERT_LE(++made, 133);
  }
  const auto found = plane.judged();
  int wrong = 0;
  for (const auto& cell : found.cells()) wrong += (cell.probability > 0.5) != beyond(cell.x, cell.y) ? 1 : 0;
  EXPECT_LE(wrong, 4) << "of 400, with " << made << " runs";
  const auto near = std::ranges::count_if(found.cells(), [&](const EnvelopeCell& cell) {
    if (cell.yes + cell.no == 0) return false;
    for (const auto& other : found.cells())
      if (std::abs(double(other.x) - double(cell.x)) + std::abs(double(other.y) - double(cell.y)) == 1 &&
          beyond(other.x, other.y) != beyond(cell.x, cell.y))
        return true;
    return false;
  });
  EXPECT_GE(2 * near, made) << "of the runs beside the line";
}

TEST(EnvelopePlane, random_runs_gather_where_the_probability_is_near_the_level) {
  constexpr std::size_t number = 12, draws = 20;
  Plane plane(number, draws);
  const auto probability = [](std::size_t x, std::size_t y) { return 1 / (1 + std::exp(6.5 - 0.5 * double(x + y))); };
  RandomShares random(3, "envelope");
  for (int made = 0; made < 400; ++made) {
    const auto run = plane.judged().next();
    if (!run) break;
    plane.answer(*run, random.share() < probability(plane.runs[*run].value[0], plane.runs[*run].value[1]));
  }
  double at_line = 0, cells_at_line = 0, far = 0, cells_far = 0;
  const auto judged = plane.judged();
  for (const auto& cell : judged.cells()) {
    const double p = probability(cell.x, cell.y), runs = double(cell.yes + cell.no);
    if (std::abs(p - 0.5) < 0.15) at_line += runs, ++cells_at_line;
    if (std::abs(p - 0.5) <= 0.4) continue;
    far += runs;
    ++cells_far;
    EXPECT_EQ(cell.probability > 0.5, p > 0.5) << cell.x << " " << cell.y;
  }
  EXPECT_GT(at_line / cells_at_line, 4 * far / cells_far);
}

TEST(EnvelopePlane, runs_at_work_are_not_chosen_again_and_the_next_ones_lie_elsewhere) {
  Plane plane(8, 3);
  const auto same_cell = [&](std::size_t a, std::size_t b) {
    return plane.runs[a].value[0] == plane.runs[b].value[0] && plane.runs[a].value[1] == plane.runs[b].value[1];
  };
  std::vector<std::size_t> at_work;
  for (int k = 0; k < 4; ++k) {
    const auto run = plane.judged(at_work).next();
    ASSERT_TRUE(run);
    for (const std::size_t other : at_work) EXPECT_FALSE(same_cell(*run, other));
    at_work.push_back(*run);
  }
}

TEST(EnvelopePlane, no_draw_comes_twice_before_each_has_come_once) {
  constexpr std::size_t number = 6, draws = 9;
  Plane plane(number, draws);
  std::vector<int> used(draws, 0);
  for (std::size_t made = 0; made < draws; ++made) {
    const auto run = plane.judged().next();
    ASSERT_TRUE(run);
    ++used[plane.runs[*run].value[2]];
    plane.answer(*run, made % 2 == 0);
  }
  for (const int times : used)
    EXPECT_EQ(times, 1) << "with one draw for all cells, answers nearby would repeat each other";
}

const std::string sea_study = R"toml(scene = "scene.toml"
[constants]
base = 2
[samples]
number = 512
plan = "sobol"
[[axis]]
name = "hs"
key = "body.wedge.mass"
distribution = {type = "weibull", shape = 1.5, scale = 2, max = 10}
[[axis]]
name = "tp"
key = "fluid.density"
distribution = {type = "lognormal", mean = "base + 3*sqrt(hs)", sd = "0.1*(base + 3*sqrt(hs))"}
[[derived]]
key = "time.end"
value = "0.001*tp/base"
[[quantity]]
name = "speed"
quantity = "last(vy)"
table = "bodies.csv:wedge"
)toml";

TEST_F(StudyTest, pairs_are_drawn_together_by_conditional_distributions) {
  const auto study = read(sea_study);
  std::vector<double> logs;
  for (std::size_t k = 0; k < 512; ++k) {
    const double hs = *study.axes[0].values[k].number, tp = *study.axes[1].values[k].number;
    logs.push_back(std::log(tp / (2 + 3 * std::sqrt(hs))));
  }
  const auto found = statistics_of(logs);
  // ln of a lognormal number over its mean: mean -s^2/2, deviation s, s^2 = ln(1 + 0.1^2), whatever the condition.
  const double s = std::sqrt(std::log1p(0.01));
  EXPECT_NEAR(found.deviation, s, 0.02 * s);
  EXPECT_NEAR(found.mean, -s * s / 2, 0.02 * s);
  double product = 0;
  for (std::size_t k = 0; k < 512; ++k)
    product += (logs[k] - found.mean) / s * std::log(*study.axes[0].values[k].number);
  EXPECT_LT(std::abs(product / 512), 0.05) << "what is left does not depend on the condition";
}

TEST_F(StudyTest, derived_keys_follow_axes_and_constants) {
  const auto study = read(sea_study);
  const auto runs = expand(study);
  for (const std::size_t k : {0u, 7u, 511u})
    EXPECT_EQ(runs[k].set.back(), "time.end=" + fmt::format("{}", 0.001 * *study.axes[1].values[k].number / 2));
}

TEST_F(StudyTest, mistakes_in_conditions_derived_keys_and_envelopes_are_told) {
  const auto first = [&](const std::string& text) {
    const auto messages = messages_of(text);
    return messages.empty() ? std::string("nothing") : messages.front();
  };
  const auto told = [&](const std::string& was, const std::string& is) { return first(replaced(sea_study, was, is)); };
  EXPECT_NE(told("mean = \"base", "mean = \"tp").find("'tp' is neither a constant nor a random axis"),
            std::string::npos);
  EXPECT_NE(told("sd = \"0.1*", "sd = \"(hs - 1)*").find("positive standard deviation"), std::string::npos);
  EXPECT_NE(told("0.001*tp/base", "0.001*tq/base").find("Did you mean 'tp'?"), std::string::npos);
  EXPECT_NE(told("0.001*tp/base", "0*tp/(base - 2)").find("no finite value"), std::string::npos);
  EXPECT_NE(told("key = \"time.end\"", "key = \"time.ent\"").find("derived: time.ent"), std::string::npos);
  EXPECT_EQ(told("key = \"fluid.density\"\n", ""), "nothing") << "a derived key uses it";
  EXPECT_NE(told("key = \"body.wedge.mass\"\n", "").find("axis.hs.key is missing"), std::string::npos);
  const std::string plane = R"toml(scene = "scene.toml"
[[axis]]
name = "mass"
key = "body.wedge.mass"
values = [100, 200, 300]
[[axis]]
name = "end"
key = "time.end"
values = [0.01, 0.02]
[[limit]]
name = "heavy"
quantity = "mass"
above = 150
[envelope]
limit = "heavy"
x = "mass"
y = "end"
runs = 5
)toml";
  EXPECT_EQ(first(plane), "nothing");
  EXPECT_NE(first(replaced(plane, "y = \"end\"", "y = \"mass\"")).find("is the axis of x too"), std::string::npos);
  EXPECT_NE(first(replaced(plane, "limit = \"heavy\"", "limit = \"heave\"")).find("Did you mean 'heavy'?"),
            std::string::npos);
  EXPECT_NE(first(replaced(plane, "runs = 5\n", "")).find("how many runs"), std::string::npos);
}

TEST(EnvelopePlane, is_told_for_a_grid_without_chance) {
  Plane plane(4, 1);
  for (std::size_t run = 0; run < 16; run += 5) plane.answer(run, run > 7);
  const auto campaign = campaign_of(plane.study, plane.runs, plane.outcomes);
  ASSERT_TRUE(campaign && campaign->envelope);
  EXPECT_EQ(campaign->envelope->cells.size(), 16u);
  EXPECT_EQ(json_of(*campaign)["envelope"]["cells"].size(), 16u);
}

}  // namespace
}  // namespace splashdown::apps::envelope_test
