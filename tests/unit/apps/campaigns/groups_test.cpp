// Statistics of groups of runs, and how bands narrow as runs are added.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "apps/study/campaign/results.hpp"
#include "tests/unit/apps/study_scene.hpp"

namespace splashdown::apps::groups_test {
namespace {

using testing::StudyTest;

TEST_F(StudyTest, statistics_are_told_by_factor_and_for_the_groups_that_are_named) {
  const std::string text = R"toml(scene = "scene.toml"
[[axis]]
name = "mass"
key = "body.wedge.mass"
values = [100, 200]
[[axis]]
name = "end"
key = "time.end"
values = [0.01, 0.02]
[[axis]]
name = "density"
key = "fluid.density"
values = [900, 950, 1000]
[[quantity]]
name = "speed"
quantity = "last(vy)"
table = "bodies.csv:wedge"
[[group]]
by = ["density", "mass"]
)toml";
  const auto study = read(text);
  const auto runs = expand(study);
  std::vector<Outcome> outcomes(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    outcomes[i].status = Outcome::Status::converged;
    outcomes[i].numbers["speed"] =
        static_cast<double>(100 * runs[i].value[0] + 10 * runs[i].value[1] + runs[i].value[2]);
  }
  const auto campaign = campaign_of(study, runs, outcomes);
  ASSERT_TRUE(campaign);
  ASSERT_EQ(campaign->statistics.size(), 1u + 2 + 2 + 3 + 6);
  double means = 0;
  for (const auto& entry : campaign->statistics) {
    double expected = 0;
    const std::vector<double> values = {100, 10, 1}, middles = {50, 5, 1};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto at =
          std::ranges::find(entry.group->at, study.axes[a].name, [](const auto& pair) { return pair.first; });
      expected +=
          at == entry.group->at.end() ? middles[a] : values[a] * static_cast<double>(*study.axes[a].find(at->second));
    }
    EXPECT_DOUBLE_EQ(entry.found.mean, expected);
    EXPECT_TRUE(entry.growth.empty()) << "nothing is left to chance";
    if (entry.group->at.size() == 2) means += entry.found.mean * static_cast<double>(entry.found.runs);
  }
  EXPECT_DOUBLE_EQ(means, 12 * campaign->statistics[0].found.mean) << "groups share the runs out";
}

TEST_F(StudyTest, bands_of_means_are_told_as_runs_are_added) {
  const auto study = read(R"toml(scene = "scene.toml"
[samples]
number = 24
plan = "random"
[[axis]]
name = "mass"
key = "body.wedge.mass"
range = [100, 200]
[[quantity]]
name = "speed"
quantity = "last(vy)"
table = "bodies.csv:wedge"
)toml");
  const auto runs = expand(study);
  std::vector<Outcome> outcomes(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    outcomes[i].status = Outcome::Status::converged;
    outcomes[i].numbers["speed"] = static_cast<double>(i * i % 7);
  }
  const auto campaign = campaign_of(study, runs, outcomes);
  ASSERT_TRUE(campaign);
  const auto& growth = campaign->statistics[0].growth;
  ASSERT_EQ(growth.size(), 5u);
  for (std::size_t k = 0; k < growth.size(); ++k) EXPECT_EQ(growth[k].runs, k < 4 ? 2u << k : 24u);
  EXPECT_DOUBLE_EQ(growth[0].mean, 0.5);
  EXPECT_DOUBLE_EQ(growth.back().mean, campaign->statistics[0].found.mean);
  EXPECT_DOUBLE_EQ(growth.back().band->high, campaign->statistics[0].found.mean_band->high);
}

}  // namespace
}  // namespace splashdown::apps::groups_test
