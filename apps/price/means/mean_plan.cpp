#include "apps/price/means/mean_plan.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::apps {
namespace {

/// Runs are added in portions of this share of those that are there, and each price is found to that.
constexpr int portion = 8;

class Path {
 public:
  Path(std::span<const SizeOfMesh> sizes, const BandOfMean& band, std::size_t mean) : sizes_(sizes), band_(band) {
    plan_.mean = mean;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      plan_.runs.push_back({sizes[i].h, i == mean ? std::max(sizes[i].made, fewest_of_mean) : sizes[i].made});
    count();
  }

  const MeanPlan& plan() const { return plan_; }

  /// To the portion of runs that narrows the band most a second; false: nothing does.
  bool step() {
    std::size_t best = sizes_.size();
    double most = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      const int more = added(i);
      if (more == 0) continue;
      auto& runs = plan_.runs[i].runs;
      runs += more;
      const double gain = (plan_.band - band_(plan_.runs, plan_.mean)) / (more * sizes_[i].seconds);
      runs -= more;
      if (gain > most) best = i, most = gain;
    }
    if (best == sizes_.size()) return false;
    plan_.runs[best].runs += added(best);
    count();
    return true;
  }

 private:
  int added(std::size_t i) const {
    const int runs = plan_.runs[i].runs;
    return std::min(std::max(1, runs / portion), most_of_size - runs);
  }

  void count() {
    plan_.band = band_(plan_.runs, plan_.mean);
    plan_.seconds = plan_.missing_seconds = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      const double missing = (plan_.runs[i].runs - sizes_[i].made) * sizes_[i].seconds;
      plan_.missing_seconds += missing;
      plan_.seconds += i == plan_.mean ? plan_.runs[i].runs * sizes_[i].seconds : missing;
    }
  }

  std::span<const SizeOfMesh> sizes_;
  const BandOfMean& band_;
  MeanPlan plan_;
};

/// Of those that take no longer, the one with the narrowest band and something left to make; null: there is none.
const MeanPlan* most_telling(std::span<const MeanPlan> plans, double seconds) {
  const MeanPlan* best = nullptr;
  for (const auto& plan : plans)
    if (plan.missing_seconds > 0 && plan.missing_seconds <= seconds && (best == nullptr || plan.band < best->band))
      best = &plan;
  return best;
}

/// Half of what the plan lacks of its coarsest size that lacks any: what these say may change the plan.
NextRuns first_of(const MeanPlan& plan, std::span<const SizeOfMesh> sizes) {
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (const int lacks = plan.runs[i].runs - sizes[i].made; lacks > 0) return {i, (lacks + 1) / 2};
  return {plan.mean, 1};  // all are there, and their band is wider than it was expected
}

}  // namespace

double band_of_scatter(double deviation, int runs) {
  return students_limit(runs - 1, 0.95) * deviation / std::sqrt(static_cast<double>(runs));
}

std::vector<MeanPlan> mean_plans(std::span<const SizeOfMesh> sizes, const BandOfMean& band, double tightest) {
  std::vector<MeanPlan> plans;
  for (std::size_t mean = 0; mean < sizes.size(); ++mean) {
    Path path(sizes, band, mean);
    if (!std::isfinite(path.plan().band)) continue;
    do plans.push_back(path.plan());
    while (plans.back().band > tightest && path.step());
  }
  return plans;
}

const MeanPlan* cheapest(std::span<const MeanPlan> plans, double wanted, double MeanPlan::*seconds) {
  const MeanPlan* best = nullptr;
  for (const auto& plan : plans)
    if (plan.band <= wanted && (best == nullptr || plan.*seconds < best->*seconds)) best = &plan;
  return best;
}

std::optional<NextRuns> next_runs(const LadderState& state, const BandOfMean& band, double wanted) {
  auto sizes = state.sizes;
  const auto finer = sizes.size();
  if (state.finer) sizes.push_back(*state.finer), sizes.back().made = 0;
  auto plans = mean_plans(sizes, band, wanted);
  // All of its runs are there, and no mesh is left: it was expected to have the band, and has not.
  std::erase_if(
      plans, [&](const MeanPlan& plan) { return plan.missing_seconds == 0 && sizes[plan.mean].made >= most_of_size; });
  const auto* plan = cheapest(plans, wanted, &MeanPlan::missing_seconds);
  if (plan != nullptr && plan->missing_seconds < state.single_seconds) return first_of(*plan, sizes);
  if (state.single_seconds < HUGE_VAL && state.finer) return NextRuns{finer, 1};
  if (!state.finer) return plan != nullptr ? std::optional(first_of(*plan, sizes)) : std::nullopt;
  const auto* telling = most_telling(plans, state.finer->seconds - state.seconds_since_finer);
  return telling != nullptr ? first_of(*telling, sizes) : NextRuns{finer, 1};
}

}  // namespace splashdown::apps
