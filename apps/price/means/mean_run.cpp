#include "apps/price/means/mean_run.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/files/csv.hpp"
#include "apps/files/folder_lock.hpp"
#include "apps/price/means/replicates.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/scene/numbers.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/statistics/verdict/limits.hpp"
#include "apps/study/folder.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

LadderOrder order_of(const MeanOrder& mean) {
  LadderOrder order;
  order.scene = mean.options.scene;
  order.folder = fs::absolute(mean.folder / replicates_folder).lexically_normal();
  order.set = mean.options.overrides;
  order.refine_keys = refine_keys_of(order.scene, order.set);
  order.threads = mean.options.threads;
  order.budget = mean.seconds;
  order.large = mean.options.large;
  order.quiet = mean.options.quiet;
  order.dimension = mean.price.dimension;
  order.expected_nodes = mean.price.expected_nodes;
  order.quantities = quantities_of(mean.price);
  return order;
}

/// Sizes that a mean may need beyond those that are there, as far as prices are extrapolated.
std::vector<double> finer_than(const MeanOrder& order) {
  std::vector<double> finer;
  for (double factor = std::sqrt(2.); factor < 1.01 * farthest_extrapolation; factor *= std::sqrt(2.)) {
    const double refine = std::stod(digits_of(factor * order.price.finest()));
    if (!scene_at(order.options.scene, order.options.overrides, refine)) break;
    finer.push_back(refine);
  }
  return finer;
}

std::optional<MeanFound> best_of(const Price& price) {
  std::optional<MeanFound> best;
  for (const auto& size : price.sizes()) {
    const auto band = price.reached_by_mean(1 / size.h);
    if (band && (!best || band->first < best->band.first))
      best = {.refine = 1 / size.h, .runs = size.made, .seconds = 0, .band = *band, .limits = {}};
  }
  return best;
}

Json runs_of(const Price& price, double refine) {
  Json runs = Json::array();
  for (const auto& rung : price.rungs) {
    if (rung.spec.role == Role::larger_tank || std::abs(rung.spec.refine / refine - 1) >= same_size) continue;
    runs.push_back({{"refine", rung.spec.refine}, {"seconds", rung.seconds}});
    for (const auto& quantity : price.quantities)
      if (const double value = quantity.at(rung.spec); std::isfinite(value))
        runs.back()["values"][quantity.what.name] = value;
  }
  return runs;
}

Json json_of(const Price& price, const MeanFound& found) {
  Json json = {{"runs", found.runs},
               {"refine", found.refine},
               {"band_percent", 100 * found.band.first},
               {"decided_by", found.band.second},
               {"quantities", Json::object()}};
  for (const auto& quantity : price.quantities)
    if (const auto mean = quantity.mean(found.refine))
      json["quantities"][quantity.what.name] = {{"value", mean->value},         {"band", mean->band},
                                                {"deviation", mean->deviation}, {"runs", mean->runs},
                                                {"unit", quantity.what.unit},   {"counts", quantity.what.counts}};
  json["of"] = runs_of(price, found.refine);
  return json;
}

/// Means by the paths of their numbers, as limits know them.
MeanNumbers numbers_of_means(const Price& price, double refine) {
  MeanNumbers numbers;
  for (const auto& quantity : price.quantities)
    if (const auto mean = quantity.mean(refine); mean && !quantity.what.path.empty())
      numbers[quantity.what.path] = {mean->value, mean->band, mean->runs};
  return numbers;
}

/// Beside what the run itself wrote; the answers to limits go by the means.
void add_to_summary(const MeanOrder& order, const Price& price, MeanFound& found) {
  const auto scene = read_scene(order.options.scene, order.options.overrides).scene;
  std::ifstream in(order.folder / "summary.json");
  auto summary = Json::parse(in);
  summary["mean_of_runs"] = json_of(price, found);
  found.limits = answered(scene.limits, numbers_of(scene), nlohmann::json::parse(summary.dump()), scene.time.end,
                          numbers_of_means(price, found.refine));
  for (const auto& limit : found.limits) summary["limits"][limit.name] = json_of(limit);
  write_file_atomically(order.folder / "summary.json",
                        summary.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

std::optional<MeanPlan> mean_in(const Price& price, double seconds) {
  if (price.rungs.empty()) return {};
  const auto sizes = price.sizes();
  const auto plans = mean_plans(sizes, price.expected_of_mean(), 0);
  const MeanPlan* best = nullptr;
  for (const auto& plan : plans)
    if (plan.missing_seconds <= seconds && (best == nullptr || plan.band < best->band)) best = &plan;
  return best == nullptr ? std::nullopt : std::optional(*best);
}

std::optional<MeanFound> make_mean(const MeanOrder& order) {
  const auto before = measured_runs(order.price);
  const auto finer = finer_than(order);
  Ladder ladder(order_of(order), {{order.price.finest(), Role::rung}});
  make_study_folder(order.folder / replicates_folder);
  const FolderLock lock(order.folder / replicates_folder);
  const auto price = [&] {
    auto all = before;
    all.insert(all.end(), ladder.made().begin(), ladder.made().end());
    std::vector<std::string> unused;
    auto made = price_of(all, quantities_of(order.price), order.price.dimension, unused);
    made.expected_nodes = order.price.expected_nodes;
    return made;
  };
  for (const double refine : finer)
    if (!ladder.allow({refine, Role::rung})) break;
  climb_to(ladder, {.accuracy = order.accuracy, .finer = finer, .price = price, .by_mean = true});
  if (interrupt_received()) return {};
  const auto all = price();
  auto found = best_of(all);
  if (!found) return {};
  for (const auto& run : ladder.made()) found->seconds += run.seconds;
  add_to_summary(order, all, *found);
  return found;
}

}  // namespace splashdown::apps
