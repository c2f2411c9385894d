#include "apps/price/command.hpp"

#include <fmt/format.h>

#include "apps/files/csv.hpp"
#include "apps/files/folder_lock.hpp"
#include "apps/price/advice.hpp"
#include "apps/price/cost.hpp"
#include "apps/price/means/replicates.hpp"
#include "apps/price/write.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/report/report.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/scene/choose/refine.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/study/folder.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

struct PricePlan {
  LadderOrder order;
  std::vector<double> refines;  ///< of the ladder
  std::vector<double> finer;    ///< that may follow it
  double accuracy = 0;          ///< that one of all is to have
  bool goes_on = false;         ///< to the finer ones, until one has it
  std::string title, digest;
  bool has_tank = false;
  bool replicates = true;  ///< meshes of equal size tell how values scatter
};

/// What a list begins with: without a mesh that has it, a budget is better spent than kept.
constexpr double least_accuracy = 0.2;

/// Meshes that may follow the ladder, of those that the scene allows.
std::vector<double> finer_than(const std::vector<double>& refines, const PriceOptions& options, double own) {
  auto all = rung_refines(most_rungs, own);
  while (all.size() > refines.size() && !scene_at(options.scene, options.set, all.back())) all.pop_back();
  return {all.begin() + static_cast<std::ptrdiff_t>(refines.size()), all.end()};
}

/// Throws SceneError.
PricePlan plan_of(const PriceOptions& options) {
  const auto file = read_scene(options.scene, options.set);
  const auto& scene = file.scene;
  if (refine_keys(scene).empty())
    throw SceneError(
        {fmt::format("{}: has no [fluid] and no [body.elastic], so there is no mesh to refine. Use "
                     "splashdown run.",
                     options.scene.string())});
  PricePlan plan;
  plan.title = scene.title;
  plan.has_tank = scene.tank.has_value();
  plan.refines = rung_refines(options.rungs, refine_of(scene));
  plan.finer = finer_than(plan.refines, options, refine_of(scene));
  plan.goes_on = options.accuracy || options.budget;
  plan.accuracy = options.accuracy ? *options.accuracy / 100 : least_accuracy;
  plan.digest = digest_of_scene(options.scene, options.set);
  auto& order = plan.order;
  order.scene = options.scene;
  // Absolute: the runs' messages name their folders.
  order.folder = fs::absolute(options.out.value_or(price_directory(options.scene))).lexically_normal();
  order.set = options.set;
  order.refine_keys = refine_keys(scene);
  order.threads = options.threads;
  order.budget = options.budget;
  order.large = options.large;
  order.quiet = options.quiet;
  order.dimension = scene.dimension;
  if (options.open_water) order.larger_tank = larger_tank_of(scene, options.scene.string());
  const auto& finest = plan.goes_on && !plan.finer.empty() ? plan.finer.back() : plan.refines.back();
  order.expected_nodes =
      expected_nodes(options.scene, options.set, plan.refines.front(), farthest_extrapolation * finest);
  auto& quantities = order.quantities;
  for (const auto& argument : options.quantities) quantities.push_back(parsed_quantity(argument));
  // Who names quantities wants these at their price; the others are shown beside them.
  for (auto& quantity : default_quantities(scene)) {
    quantity.counts &= options.quantities.empty();
    quantities.push_back(std::move(quantity));
  }
  check_price_quantities(quantities, scene);
  plan.replicates = std::ranges::any_of(
      quantities, [](const PriceQuantity& quantity) { return quantity.counts && quantity.told.empty(); });
  if (quantities.empty())
    throw SceneError(
        {fmt::format("{}: has no body and no record to measure. Name what matters, e.g. --quantity "
                     "\"level=last(value) from probes.csv:gauge\".",
                     options.scene.string())});
  return plan;
}

/// What to do next.
std::string next_text(const PricePlan& plan, const Price& price, const Ladder& ladder, const PriceOptions& options) {
  std::string text;
  if (plan.has_tank && !options.open_water)
    text += "what the tank does is not in these bands: if it stands for open water, --open-water adds it\n";
  if (ladder.end().interrupted) return text + "stopped; the same command continues\n";
  if (ladder.end().out_of_budget)
    return text + "the budget ended the ladder; with a larger one the same command continues\n";
  if (price.rows.empty() || price.is_reached(plan.accuracy)) return text;
  const double percent = 100 * plan.accuracy;
  const auto next = std::ranges::find_if(plan.finer, [&](double refine) { return refine > price.finest(); });
  if (next == plan.finer.end() || scatters_too_much(price, plan.accuracy))
    return text + fmt::format("no mesh has {:g} % yet: {}\n", percent,
                              advice_for(price, {options.scene, options.set, plan.accuracy,
                                                 options.out.value_or(price_directory(options.scene))}));
  return text + fmt::format("no mesh has {0:g} % yet: --accuracy {0:g}% goes on, the next one takes about {1}\n",
                            percent, about_time(ladder.seconds_at(*next).value_or(0)));
}

void write_price(const Price& price, const fs::path& folder, std::vector<std::string>& notes) {
  write_file_atomically(folder / price_file, price_json(price));
  if (auto note = draw_price(price, folder)) notes.push_back(std::move(*note));
  write_report(folder);
}

/// Of what was made.
Price price_of(const PricePlan& plan, const Ladder& ladder, std::vector<std::string>& notes) {
  auto price = price_of(ladder.made(), plan.order.quantities, plan.order.dimension, notes);
  price.expected_nodes = plan.order.expected_nodes;
  return price;
}

int conclude(const PricePlan& plan, const Ladder& ladder, const PriceOptions& options) {
  const auto& folder = plan.order.folder;
  auto notes = ladder.end().notes;
  auto price = price_of(plan, ladder, notes);
  price.percent = listed_percent(options.accuracy);
  price.asked = plan.accuracy;
  list_rows(price);
  price.scene = fs::absolute(options.scene).lexically_normal().string();
  price.title = plan.title;
  price.scene_digest = plan.digest;
  leave_at_interrupt(options.quiet ? "" : "\nstopped while the chart was drawn: the same command draws it\n");
  if (!price.rungs.empty()) write_price(price, folder, notes);
  if (!options.quiet) {
    fmt::print("{}", price_text(price));
    for (const auto& note : notes) fmt::print(stderr, "note: {}\n", note);
    if (const auto line = price_line(price); !line.empty()) fmt::print("{}\n", line);
    fmt::print("  files       {}/: report.html price.json{}\n", folder.string(),
               fs::exists(folder / "price.svg") ? " price.svg" : "");
    fmt::print("{}", next_text(plan, price, ladder, options));
  }
  if (ladder.end().interrupted) return exit_code::interrupted;
  if (!price.rows.empty()) return exit_code::done;
  fmt::print(stderr, "error: no price: three meshes have to reach their end, and {} did\n", ladder.made().size());
  return ladder.end().out_of_budget ? exit_code::interrupted : exit_code::cannot_go_on;
}

}  // namespace

fs::path price_directory(const fs::path& scene) { return default_directory(scene).string() + "_price"; }

int price_command(const PriceOptions& options) {
  PricePlan plan;
  std::optional<Ladder> ladder;
  std::optional<FolderLock> lock;
  try {
    plan = plan_of(options);
    auto possible = possible_rungs(plan.refines, options.open_water);
    for (const double refine : plan.finer) possible.push_back({refine, Role::rung});
    ladder.emplace(plan.order, possible);
    if (const auto refused = unwritable(plan.order.folder)) return bad_input(*refused);
    std::string foreign;
    for (const auto& message : foreign_places(ladder->runs(), plan.order.folder)) foreign += message + "\n";
    if (fs::exists(plan.order.folder / "study.json"))
      foreign += fmt::format("{}: holds a study. Use another --out.\n", plan.order.folder.string());
    if (!foreign.empty()) return bad_input(foreign);
    make_study_folder(plan.order.folder);
    lock.emplace(plan.order.folder);
  } catch (const std::exception& error) {
    return bad_input(trouble(error));
  }
  catch_interrupts(options.quiet ? "" : "\nstopping: the run saves its checkpoint\n");
  climb_all(*ladder, plan.refines, options.open_water, plan.replicates);
  if (plan.goes_on)
    climb_to(*ladder, {plan.accuracy, plan.finer, [&] {
                         std::vector<std::string> unused;
                         return price_of(plan, *ladder, unused);
                       }});
  return conclude(plan, *ladder, options);
}

}  // namespace splashdown::apps
