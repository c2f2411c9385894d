// Campaigns: what random axes draw, what is said of many runs, and how often it is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "apps/study/campaign/results.hpp"
#include "apps/study/design/distribution.hpp"
#include "apps/study/design/fraction.hpp"
#include "apps/study/design/shares.hpp"
#include "tests/unit/apps/study_scene.hpp"

namespace splashdown::apps::campaign_test {
namespace {

using testing::replaced;
using testing::StudyTest;

std::vector<Distribution> all_distributions() {
  using enum Distribution::Type;
  std::vector<Distribution> all;
  for (const auto type : {uniform, log_uniform, normal, lognormal, weibull})
    all.push_back({type, 1.5, 2.5, {}, {}, {}, {}});
  all.push_back({table, 0, 0, {0, 1, 4}, {0, 0.25, 1}, {}, {}});
  return all;
}

TEST(Distribution, quantiles_ascend_and_have_the_mean_and_the_median_of_the_law) {
  using enum Distribution::Type;
  const double gamma_of_weibull = std::tgamma(1 + 1 / 1.5);
  const std::vector<double> means = {2,   1 / std::log(2.5 / 1.5), 1.5,
                                     1.5, 2.5 * gamma_of_weibull,  0.25 * 0.5 + 0.75 * 2.5};
  const auto all = all_distributions();
  for (std::size_t i = 0; i < all.size(); ++i) {
    double before = -HUGE_VAL;
    for (int k = 0; k < 100; ++k) {
      const double value = quantile(all[i], k / 100.);
      EXPECT_TRUE(std::isfinite(value)) << i;
      EXPECT_GT(value, before) << i << " at " << k;
      before = value;
    }
    // A thousand equal shares miss what lies in the outermost halves of them.
    EXPECT_NEAR(mean_of(all[i]), means[i], 0.01 * means[i]) << i;
  }
  EXPECT_NEAR(quantile(all[2], 0.5), 1.5, 1e-12);
  EXPECT_NEAR(quantile(all[4], 0.5), 2.5 * std::pow(std::numbers::ln2, 1 / 1.5), 1e-12);
}

TEST(Distribution, what_is_cut_off_never_occurs_and_the_rest_keeps_its_proportions) {
  Distribution d{Distribution::Type::normal, 0, 1, {}, {}, -1, 2};
  EXPECT_GE(quantile(d, 0), -1);
  EXPECT_LE(quantile(d, 1 - 1e-16), 2);
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  for (const double u : {0.1, 0.5, 0.9})
    EXPECT_NEAR(below(quantile(d, u)), below(-1) + u * (below(2) - below(-1)), 1e-12);
}

TEST(Shares, of_a_latin_hypercube_lie_in_each_part_once) {
  for (const auto& axis : shares_of(Plan::latin_hypercube, 17, 3, {"a", "b"})) {
    auto parts = axis;
    for (auto& share : parts) share = std::floor(17 * share);
    std::ranges::sort(parts);
    for (int k = 0; k < 17; ++k) EXPECT_EQ(parts[static_cast<std::size_t>(k)], k);
  }
}

TEST(Shares, of_a_sequence_are_continued_by_a_larger_number_and_changed_by_the_seed) {
  for (const Plan plan : {Plan::sobol, Plan::random}) {
    const auto few = shares_of(plan, 10, 1, {"a", "b"}), many = shares_of(plan, 100, 1, {"a", "b"});
    for (std::size_t a = 0; a < 2; ++a) EXPECT_TRUE(std::equal(few[a].begin(), few[a].end(), many[a].begin()));
    EXPECT_NE(few[0], few[1]);
    EXPECT_NE(few, shares_of(plan, 10, 2, {"a", "b"}));
  }
}

TEST(Shares, of_sobols_sequence_fill_a_square_better_than_chance) {
  // Mean of a product: chance errs by 0.22 / sqrt(n) (its standard deviation), the sequence by O(log^2 n / n).
  const auto shares = shares_of(Plan::sobol, 1024, 1, {"a", "b"});
  double sum = 0;
  for (std::size_t i = 0; i < 1024; ++i) sum += shares[0][i] * shares[1][i];
  EXPECT_NEAR(sum / 1024, 0.25, 0.22 / 32 / 5);
}

TEST(Shares, of_saltellis_plan_change_one_axis_at_a_time) {
  const std::size_t n = 8;
  const auto shares = shares_of(Plan::saltelli, 8, 1, {"a", "b", "c"});
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t changed = 0; changed < 3; ++changed)
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_EQ(shares[a][(2 + changed) * n + i], shares[a][(changed == a ? n : 0) + i]);
}

TEST(SobolIndices, of_ishigamis_function_are_within_three_per_cent) {
  // Ishigami and Homma 1990, a = 7, b = 0.1: variances of the terms in closed form.
  const double a = 7, b = 0.1, pi4 = std::pow(std::numbers::pi, 4), pi8 = pi4 * pi4;
  const double v1 = 0.5 * std::pow(1 + b * pi4 / 5, 2), v2 = a * a / 8, v13 = b * b * pi8 * (1. / 18 - 1. / 50),
               v = v1 + v2 + v13;
  const auto shares = shares_of(Plan::saltelli, 4096, 1, {"x", "y", "z"});
  std::vector<std::optional<double>> values;
  for (std::size_t i = 0; i < shares[0].size(); ++i) {
    const auto at = [&](std::size_t k) { return std::numbers::pi * (2 * shares[k][i] - 1); };
    values.push_back(std::sin(at(0)) + a * std::pow(std::sin(at(1)), 2) + b * std::pow(at(2), 4) * std::sin(at(0)));
  }
  std::size_t rows = 0;
  const auto found = sobol_indices(values, 3, rows);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(rows, 4096u);
  const std::vector<double> first = {v1 / v, v2 / v, 0}, total = {(v1 + v13) / v, v2 / v, v13 / v};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found[k].first, first[k], 0.03 * (v2 / v)) << k;
    EXPECT_NEAR(found[k].total, total[k], 0.03 * (v2 / v)) << k;
    EXPECT_LE(found[k].total_band.low, total[k]);
    EXPECT_GE(found[k].total_band.high, total[k]);
  }
  // Runs that broke down take their rows along and nothing else.
  values[5].reset();
  sobol_indices(values, 3, rows);
  EXPECT_EQ(rows, 4095u);
}

TEST(Effects, of_a_known_polynomial_are_exact_in_full_and_fractional_designs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-5, 5);
  for (int trial = 0; trial < 20; ++trial) {
    const double mean = any(random), a = any(random), b = any(random), c = any(random), ac = any(random);
    std::vector<FactorialRun> full, half;
    for (Factors high = 0; high < 8; ++high) {
      const auto x = [&](int k) { return high >> k & 1 ? 1. : -1.; };
      full.push_back({high, mean + a * x(0) + b * x(1) + c * x(2) + ac * x(0) * x(2)});
      if (x(0) * x(1) * x(2) > 0) half.push_back(full.back());
    }
    for (const auto& effect : effects_of(full, 3, Fraction({}))) {
      const double exact = effect.factors == 1   ? a
                           : effect.factors == 2 ? b
                           : effect.factors == 4 ? c
                           : effect.factors == 5 ? ac
                                                 : 0;
      EXPECT_NEAR(effect.value, 2 * exact, 1e-13);
    }
    // I = abc: a is one with bc, b with ac, c with ab.
    const auto found = effects_of(half, 3, Fraction({7}));
    ASSERT_EQ(found.size(), 3u);
    EXPECT_NEAR(found[1].value, 2 * (b + ac), 1e-13);
    EXPECT_EQ(found[1].aliases, std::vector<Factors>{5});
  }
}

TEST(Fraction, has_the_resolution_of_its_shortest_word) {
  // 2^(7-4) of Box, Hunter and Hunter: D = AB, E = AC, F = BC, G = ABC. Resolution III, 15 words.
  const Fraction saturated({0b0001011, 0b0010101, 0b0100110, 0b1000111});
  EXPECT_EQ(saturated.words().size(), 15u);
  EXPECT_EQ(saturated.resolution(), 3);
  EXPECT_EQ(Fraction({0b11111}).resolution(), 5);
  EXPECT_EQ(Fraction({}).resolution(), 0);
}

TEST(Bands, hold_the_truth_in_95_per_cent_of_campaigns) {
  // 1000 campaigns: the count has a standard deviation of 0.7 %, so 2 % are almost three of them.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  std::normal_distribution<double> normal;
  int wilson = 0, exact = 0, mean = 0, median = 0;
  for (int campaign = 0; campaign < 1000; ++campaign) {
    const double p = any(random);
    Probability found{.yes = 0, .runs = static_cast<std::size_t>(20 + 80 * any(random))};
    for (std::size_t i = 0; i < found.runs; ++i) found.yes += any(random) < p ? 1 : 0;
    const auto holds = [](Band band, double truth) { return band.low <= truth && truth <= band.high ? 1 : 0; };
    wilson += holds(found.wilson(), p);
    exact += holds(found.clopper_pearson(), p);
    std::vector<double> values;
    for (int i = 0; i < 12; ++i) values.push_back(normal(random));
    const auto s = statistics_of(values);
    mean += holds(*s.mean_band, 0);
    median += holds(*s.median_band, 0);
  }
  EXPECT_NEAR(wilson, 950, 20);
  EXPECT_GE(exact, 950);
  EXPECT_NEAR(mean, 950, 20);
  EXPECT_GE(median, 930);
}

TEST(TwoModes, are_told_where_there_are_two_and_seldom_where_there_is_one) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(0, 1);
  int one = 0, flat = 0, two = 0;
  for (int campaign = 0; campaign < 60; ++campaign) {
    std::vector<double> a, b, c;
    for (int i = 0; i < 60; ++i) {
      a.push_back(normal(random));
      b.push_back(any(random));
      c.push_back(normal(random) + (i % 2 == 0 ? 8 : 0));
    }
    one += statistics_of(a).split ? 1 : 0;
    flat += statistics_of(b).split ? 1 : 0;
    const auto split = statistics_of(c).split;
    two += split && *split > 1.5 && *split < 6.5 ? 1 : 0;
  }
  // 5 % of flat densities may look like two modes: of 60 more than 8 in less than one of a hundred cases. Others do so less often.
  EXPECT_LE(flat, 8);
  EXPECT_LE(one, 8);
  EXPECT_EQ(two, 60);
}

const std::string random_study = R"toml(scene = "scene.toml"
[samples]
number = 8
plan = "sobol"
[[axis]]
name = "mass"
key = "body.wedge.mass"
distribution = {type = "lognormal", mean = 100, sd = 20, max = 200}
[[axis]]
name = "sea"
[[axis.case]]
name = "calm"
set = ["time.end=0.01"]
weight = 3
[[axis.case]]
name = "rough"
set = ["time.end=0.02"]
weight = 1
[[axis]]
name = "mesh"
replicates = 3
around = 0.5
[[quantity]]
name = "speed"
quantity = "last(vy)"
table = "bodies.csv:wedge"
[[limit]]
name = "fast"
quantity = "speed"
above = 1
[stop]
of = "fast"
width = 0.5
)toml";

TEST_F(StudyTest, random_axes_vary_together_and_replicates_repeat_each_draw) {
  const auto study = read(random_study);
  const auto runs = expand(study);
  EXPECT_EQ(runs.size(), 24u);
  const auto rough =
      std::ranges::count_if(study.axes[1].values, [](const AxisValue& value) { return value.text == "rough"; });
  EXPECT_EQ(rough, 2) << "a quarter of eight, as the sequence has a point in each eighth";
  EXPECT_EQ(runs[0].set.back(), "fluid.size.refine=0.5");
  EXPECT_EQ(runs[1].set.back(), "fluid.size.refine=0.49");
  const auto more = expand(read(replaced(random_study, "number = 8", "number = 16")));
  for (std::size_t i = 0; i < runs.size(); ++i) EXPECT_EQ(runs[i].set, more[i].set) << "the sequence is continued";
}

TEST_F(StudyTest, a_campaign_counts_answers_and_leaves_out_runs_without_one) {
  const auto study = read(random_study);
  const auto runs = expand(study);
  std::vector<Outcome> outcomes(runs.size());
  for (std::size_t i = 0; i < 12; ++i) {
    outcomes[i].status = i == 11 ? Outcome::Status::failed : Outcome::Status::converged;
    if (i == 11) continue;
    outcomes[i].numbers["speed"] = static_cast<double>(i);
    outcomes[i].limits["fast"] = i > 1 ? "yes" : "no";
  }
  outcomes[2].limits["fast"] = "within the band";
  const auto campaign = campaign_of(study, runs, outcomes);
  ASSERT_TRUE(campaign);
  ASSERT_EQ(campaign->probabilities.size(), 1u);
  const auto& p = campaign->probabilities[0];
  EXPECT_EQ(p.yes, 8u);
  EXPECT_EQ(p.no, 2u);
  EXPECT_EQ(p.open, 1u);
  EXPECT_EQ(p.without, 1u) << "one broke down; what is not made yet is in neither";
  EXPECT_DOUBLE_EQ(p.band().low, (Probability{8, 11}.wilson().low));
  EXPECT_DOUBLE_EQ(p.band().high, (Probability{9, 11}.wilson().high));
  EXPECT_DOUBLE_EQ(campaign->statistics[0].found.mean, 5);
  EXPECT_NEAR(*width_of(*study.stop, study, runs, outcomes), p.band().high - p.band().low, 1e-15);
  EXPECT_FALSE(campaign_of(read(), expand(read()), std::vector<Outcome>(6))) << "a grid has neither chance nor factors";
}

TEST_F(StudyTest, a_product_halves_a_factorial_design) {
  const std::string text = R"toml(scene = "scene.toml"
[[axis]]
name = "a"
key = "body.wedge.mass"
values = [100, 200]
[[axis]]
name = "b"
key = "time.end"
values = [0.01, 0.02]
[[axis]]
name = "c"
key = "fluid.density"
values = [900, 1000]
product = ["a", "b"]
)toml";
  const auto study = read(text);
  const auto runs = expand(study);
  ASSERT_EQ(runs.size(), 4u);
  for (const auto& run : runs)
    EXPECT_EQ(run.value[2], 1 - (run.value[0] + run.value[1]) % 2) << "+1 where the signs of a and b are alike";
}

TEST_F(StudyTest, mistakes_in_campaigns_are_told_with_a_cure) {
  const auto first = [&](const std::string& was, const std::string& is) {
    const auto messages = messages_of(replaced(random_study, was, is));
    return messages.empty() ? std::string("nothing") : messages.front();
  };
  EXPECT_NE(first("sd = 20", "sd = -20").find("positive standard deviation"), std::string::npos);
  EXPECT_NE(first("plan = \"sobol\"", "plan = \"sobal\"").find("Did you mean 'sobol'?"), std::string::npos);
  EXPECT_NE(first("weight = 1\n", "").find("Give each case a weight"), std::string::npos);
  EXPECT_NE(first("quantity = \"speed\"", "quantity = \"sped\"").find("Did you mean 'speed'?"), std::string::npos);
  EXPECT_NE(first("above = 1\n", "").find("above or below"), std::string::npos);
  EXPECT_NE(first("of = \"fast\"", "of = \"fist\"").find("Did you mean 'fast'?"), std::string::npos);
  EXPECT_NE(first("replicates = 3", "replicates = 1").find("replicates"), std::string::npos);
  EXPECT_NE(first("[samples]\nnumber = 8\nplan = \"sobol\"\n", "").find("needs [samples]"), std::string::npos);
  EXPECT_NE(first("max = 200", "max = 1").find("leaves nothing"), std::string::npos);
}

}  // namespace
}  // namespace splashdown::apps::campaign_test
