// Laws of means of runs: what they cost, and how often the truth lies within their bands on drawn ladders.
#include "apps/price/means/mean_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/price/price.hpp"

namespace splashdown::apps::mean_plan_test {
namespace {

/// Levels whose means are put together with known weights: band^2 = sum_l a_l^2 s_l^2 / N_l.
struct Levels {
  std::vector<double> weighted;  ///< |a_l| s_l
  std::vector<SizeOfMesh> sizes;

  double band(std::span<const RunsOfSize> runs) const {
    double variance = 0;
    for (std::size_t l = 0; l < runs.size(); ++l) variance += weighted[l] * weighted[l] / runs[l].runs;
    return std::sqrt(variance);
  }
  /// Giles (2008): N_l = |a_l| s_l / sqrt(c_l) sum_k |a_k| s_k sqrt(c_k) / band^2.
  double optimal_runs(std::size_t l, double wanted) const {
    double sum = 0;
    for (std::size_t k = 0; k < sizes.size(); ++k) sum += weighted[k] * std::sqrt(sizes[k].seconds);
    return weighted[l] / std::sqrt(sizes[l].seconds) * sum / (wanted * wanted);
  }
};

Levels drawn_levels(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.7, 1.4), power(1.5, 3.5);
  Levels levels;
  const double growth = power(random);
  for (int l = 0; l < 4; ++l) {
    const double h = std::pow(0.5, 0.5 * l);
    levels.sizes.push_back({h, std::pow(h, -growth), 1});
    levels.weighted.push_back(share(random) * std::sqrt(levels.sizes.back().seconds));
  }
  return levels;
}

TEST(MeanPlan, has_the_runs_of_the_optimal_allocation) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const auto levels = drawn_levels(random);
    const double wanted = levels.weighted[3] / 4;
    const auto plans = mean_plans(
        levels.sizes, [&](auto runs, std::size_t) { return levels.band(runs); }, wanted);
    const auto* plan = cheapest(plans, wanted, &MeanPlan::missing_seconds);
    ASSERT_TRUE(plan);
    double optimum = 0, cost = 0;
    for (std::size_t l = 0; l < 4; ++l) {
      optimum += levels.optimal_runs(l, wanted) * levels.sizes[l].seconds;
      cost += plan->runs[l].runs * levels.sizes[l].seconds;
    }
    // Each number of runs ends within a portion, an eighth, of where it belongs; cost is flat about its optimum.
    EXPECT_LT(cost, optimum * (1 + 1. / 8)) << i;
    EXPECT_GT(cost, optimum * (1 - 1e-12)) << i;
  }
}

TEST(MeanPlan, of_runs_that_are_there_asks_for_the_others_alone) {
  Levels levels{{1, 1}, {{2, 1, 20}, {1, 4, 10}}};
  const auto plans = mean_plans(
      levels.sizes, [&](auto runs, std::size_t) { return levels.band(runs); }, 0.3);
  for (const auto& plan : plans) {
    double missing = 0;
    for (std::size_t l = 0; l < 2; ++l) missing += (plan.runs[l].runs - levels.sizes[l].made) * levels.sizes[l].seconds;
    EXPECT_NEAR(plan.missing_seconds, missing, 1e-9);
  }
  EXPECT_EQ(plans.front().missing_seconds, 0);
}

TEST(MeanPlan, of_what_no_number_of_runs_narrows_is_none) {
  const std::vector<SizeOfMesh> sizes = {{2, 1, 1}, {1, 4, 1}};
  EXPECT_TRUE(mean_plans(
                  sizes, [](auto, std::size_t) { return HUGE_VAL; }, 0.1)
                  .empty());
  const auto plans = mean_plans(
      sizes, [](auto, std::size_t) { return 0.2; }, 0.1);
  EXPECT_FALSE(cheapest(plans, 0.1, &MeanPlan::seconds));
}

TEST(NextRuns, are_those_of_a_finer_mesh_where_they_get_there_for_less) {
  const BandOfMean wide = [](auto, std::size_t) { return 1.; };
  LadderState state{.sizes = {{2, 1, 1}, {1, 8, 1}}, .finer = SizeOfMesh{0.5, 64, 0}};
  state.single_seconds = 64;
  EXPECT_EQ(next_runs(state, wide, 0.1)->size, 2u);
  // Of a mean of what is there already, all it takes is four runs of the coarsest.
  const BandOfMean narrow = [](std::span<const RunsOfSize> runs, std::size_t) { return 0.3 / runs[0].runs; };
  EXPECT_EQ(next_runs(state, narrow, 0.1)->size, 0u);
  state.finer.reset();
  EXPECT_FALSE(next_runs(state, wide, 0.1));
}

TEST(NextRuns, where_nothing_is_expected_to_get_there_take_turns_with_finer_meshes) {
  const BandOfMean falls = [](std::span<const RunsOfSize> runs, std::size_t) { return 1 + 1. / runs[0].runs; };
  LadderState state{.sizes = {{2, 1, 1}, {1, 8, 1}}, .finer = SizeOfMesh{0.5, 64, 0}};
  double beside = 0;
  while (const auto next = next_runs(state, falls, 0.1)) {
    if (next->size == 2) break;
    for (int k = 0; k < next->runs; ++k) ++state.sizes[next->size].made, beside += state.sizes[next->size].seconds;
    state.seconds_since_finer = beside;
    ASSERT_LT(beside, 1000);
  }
  EXPECT_LE(beside, state.finer->seconds);
}

TEST(NextRuns, of_a_size_whose_meshes_are_all_made_are_none) {
  const BandOfMean hopeful = [](auto, std::size_t) { return 0.05; };
  LadderState state{.sizes = {{2, 1, most_of_size}}, .finer = SizeOfMesh{1, 8, 0}};
  EXPECT_NE(next_runs(state, hopeful, 0.1)->size, 0u);
  state.finer.reset();
  EXPECT_FALSE(next_runs(state, hopeful, 0.1));
}

/// A scene that needs no run: phi = 1 + alpha h^p + second h^2p, and scatter that goes with a power of h.
struct DrawnScene {
  double order, alpha, second, scatter, growth;
  bool heavy_tails;

  double value(double h, std::mt19937& random) const {
    std::normal_distribution<double> normal;
    std::student_t_distribution<double> heavy(3);  // of variance 3
    const double error = heavy_tails ? heavy(random) / std::sqrt(3.) : normal(random);
    return 1 + alpha * std::pow(h, order) + second * std::pow(h, 2 * order) + scatter * std::pow(h, growth) * error;
  }
};

DrawnScene drawn_scene(std::mt19937& random, int i) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  DrawnScene scene{.order = between(0.5, 2),
                   .alpha = between(-0.06, 0.06),
                   .second = 0,
                   .scatter = between(0.02, 0.07),
                   .growth = 1.0 * (i % 3),
                   .heavy_tails = i / 3 % 2 == 1};
  scene.second = between(-0.3, 0.3) * scene.alpha;
  return scene;
}

/// `price --accuracy` on such a scene, by the classes that the command has.
class DrawnLadder {
 public:
  DrawnLadder(const DrawnScene& scene, std::mt19937& random) : scene_(scene), random_(random) {
    for (int k = 0; k < 4; ++k) add(std::pow(2, 0.5 * k - 1), Role::rung);
    for (const int k : {0, 1}) add(replicate_refine(runs_[2].spec.refine, k), Role::replicate);
  }

  Price price() const {
    std::vector<std::string> notes;
    return price_of(runs_, {{.name = "peak", .path = "peak", .measured = {}}}, 3, notes);
  }

  /// Nothing: more was spent than twenty ladders.
  std::optional<Price> reach(double wanted) {
    const double most = 20 * spent_;
    double since_finer = 0;
    for (;;) {
      auto now = price();
      if (now.is_reached(wanted)) return now;
      if (spent_ > most) return {};
      LadderState state{.sizes = now.sizes(), .finer = {}, .seconds_since_finer = since_finer};
      const double finer = std::sqrt(2.) * now.finest();
      state.finer = SizeOfMesh{1 / finer, seconds(finer), 0};
      const auto next = next_runs(state, now.expected_of_mean(), wanted);
      if (!next) return {};
      if (next->size == state.sizes.size()) {
        add(finer, Role::rung);
        since_finer = 0;
        continue;
      }
      const auto& size = state.sizes[next->size];
      for (int k = 0; k < next->runs && size.made + k < most_of_size; ++k, since_finer += size.seconds)
        add(replicate_refine(1 / size.h, size.made - 1 + k), Role::replicate);
    }
  }

 private:
  static double seconds(double refine) { return std::pow(refine, 2.5); }
  void add(double refine, Role role) {
    runs_.push_back({.spec = {refine, role},
                     .folder = {},
                     .seconds = seconds(refine),
                     .steps = 100,
                     .node_steps = 1e4,
                     .values = {scene_.value(1 / refine, random_)}});
    spent_ += seconds(refine);
  }

  const DrawnScene& scene_;
  std::mt19937& random_;
  std::vector<Rung> runs_;
  double spent_ = 0;
};

/// Whether all that is told to have the band has it: the best mean, or a mesh that was made.
bool truth_is_within(const Price& price, double wanted) {
  const auto& peak = price.quantities.front();
  if (const auto best = best_mean(peak); best && best->second.band <= wanted * std::abs(peak.value))
    return std::abs(best->second.value - 1) <= best->second.band;
  return std::abs(peak.value - 1) <= *peak.band_of_finest();
}

void expect_true_values_within(int scenes) {
  std::mt19937 random(7);
  const double wanted = 0.1;
  int reached = 0, within = 0;
  for (int i = 0; i < scenes; ++i) {
    const auto scene = drawn_scene(random, i);
    const auto price = DrawnLadder(scene, random).reach(wanted);
    if (!price) continue;
    ++reached;
    within += truth_is_within(*price, wanted) ? 1 : 0;
  }
  EXPECT_GT(reached, scenes / 2);
  const double slack = 2 * std::sqrt(0.95 * 0.05 / reached);  // binomial, two standard deviations
  EXPECT_GE(within / static_cast<double>(reached), 0.95 - slack) << within << " of " << reached;
}

TEST(MeanOfRuns, holds_the_true_value_of_drawn_scenes_in_nineteen_of_twenty) { expect_true_values_within(25); }

TEST(MeanOfRunsNightly, holds_the_true_value_of_hundreds_of_drawn_scenes) { expect_true_values_within(400); }

}  // namespace
}  // namespace splashdown::apps::mean_plan_test
