// run --accuracy and run --seconds: which mesh that is, and what came of it.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/cli/commands.hpp"
#include "apps/price/cost.hpp"
#include "apps/price/write.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/run/folder/folder_lock.hpp"
#include "apps/run/interrupt.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/study/folder.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

// Probes begin with a quarter of the scene's refinement, each 1.41 times finer than the one before.
constexpr double first_probe = 0.25;
constexpr int most_probes = 12;
/// An order can be refused with three meshes, and found with four.
constexpr std::size_t probes_for_accuracy = 4;
/// Of the seconds asked for: what a further probe may take, and what it may where those made do not reach far enough.
constexpr double probe_share = 0.1, last_probe_share = 0.25;

struct Aim {
  Price price;
  std::string from;  ///< where the price is from
  double spent = 0;  ///< wall seconds of probes
  double refine = 1;
  double predicted = 0;  ///< wall seconds
};

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The price list of this very scene, if somebody has made one. Throws SceneError if the one that was named is another's.
std::optional<Price> listed_price(const RunOptions& options, std::string& from) {
  const auto folder = options.price.value_or(price_directory(options.scene));
  const auto file = folder / price_file;
  if (!fs::exists(file)) {
    if (options.price)
      throw SceneError({fmt::format("--price {}: holds no price.json. Make it with splashdown price {} --out {}.",
                                    folder.string(), options.scene.string(), folder.string())});
    return {};
  }
  std::optional<Price> price;
  try {
    price = read_price(file);
  } catch (const std::runtime_error& error) {
    throw SceneError({error.what()});
  }
  const bool same = price->scene_digest == digest_of_scene(options.scene, options.overrides);
  if (!same && options.price)
    throw SceneError(
        {fmt::format("--price {}: is of another scene, or of other --set values. Make it anew with "
                     "splashdown price, or leave --price out.",
                     folder.string())});
  if (!same || price->rows.empty()) return {};
  from = file.string();
  return price;
}

/// Whether a further probe, at `next`, would say too little for what it costs.
bool enough_probes(const Ladder& ladder, const RunOptions& options, double next) {
  if (!options.seconds) return ladder.made().size() >= probes_for_accuracy;
  if (ladder.made().size() < 2) return false;
  const double share = *ladder.seconds_at(next) / *options.seconds;
  const double farthest = farthest_extrapolation * ladder.made().back().spec.refine;
  return share > last_probe_share || (share > probe_share && *ladder.seconds_at(farthest) >= *options.seconds);
}

/// Coarse runs beside the run's folder.
Price probed_price(const RunOptions& options, const Scene& scene, std::string& from) {
  LadderOrder order;
  order.scene = options.scene;
  order.folder =
      fs::absolute(options.out.value_or(default_directory(options.scene)).string() + "_probe").lexically_normal();
  order.set = options.overrides;
  order.threads = options.threads;
  order.budget = options.seconds;
  order.large = options.large;
  order.quiet = options.quiet;
  order.dimension = scene.dimension;
  order.quantities = default_quantities(scene);
  const double first = scene.fluid->size.refine * first_probe;
  order.expected_nodes = expected_nodes(options.scene, options.overrides, first, 16 * first);
  std::vector<RungSpec> probes;
  for (int k = 0; k < most_probes; ++k) probes.push_back({first * std::pow(2., 0.5 * k), Role::rung});
  Ladder ladder(order, probes);
  make_study_folder(order.folder);
  const FolderLock lock(order.folder);
  for (std::size_t k = 0; k < probes.size(); ++k) {
    if (enough_probes(ladder, options, probes[k].refine)) break;
    if (!ladder.climb(probes[k])) break;
  }
  from = fmt::format("{} coarse runs in {}", ladder.made().size(), order.folder.string());
  std::vector<std::string> unused;
  auto price = price_of(ladder.made(), order.quantities, scene.dimension, unused);
  price.expected_nodes = std::move(order.expected_nodes);
  return price;
}

std::string accuracy_text(const std::optional<std::pair<double, std::string>>& accuracy) {
  return accuracy ? fmt::format("a band of {:.2g} % ({})", 100 * accuracy->first, accuracy->second)
                  : "a band that is not known: too few meshes";
}

/// Throws SceneError if there is no such mesh.
void choose(Aim& aim, const RunOptions& options) {
  const auto& price = aim.price;
  if (price.rungs.empty())
    throw SceneError(
        {fmt::format("{}: no coarse run of it reached its end, so nothing is known of its price. Use "
                     "--refine, or mend its sizes.",
                     options.scene.string())});
  if (options.seconds) {
    const double left = std::max(*options.seconds - aim.spent, 0.);
    aim.refine = *price.refine_in(left);
  } else if (const auto refine = price.refine_for(*options.accuracy / 100)) {
    aim.refine = *refine;
  } else {
    const double far = farthest_extrapolation * price.finest();
    throw SceneError({fmt::format(
        "--accuracy {:g}%: up to refine {:.3g}, {:g} times the finest mesh made, the best is {}. Use a "
        "larger value, or splashdown price {} --rungs 5: more meshes, narrower bands.",
        *options.accuracy, far, farthest_extrapolation, accuracy_text(price.accuracy(far)), options.scene.string())});
  }
  aim.refine = std::stod(fmt::format("{:.4g}", aim.refine));
  aim.predicted = *price.seconds(aim.refine);
}

/// Throws SceneError.
Aim aim_of(const RunOptions& options) {
  const auto file = read_scene(options.scene, options.overrides);
  if (!file.scene.fluid)
    throw SceneError(
        {fmt::format("{}: has no [fluid], so there is no mesh to choose. Leave --accuracy and --seconds "
                     "out.",
                     options.scene.string())});
  Aim aim;
  const double begin = wall();
  if (auto listed = listed_price(options, aim.from))
    aim.price = std::move(*listed);
  else
    aim.price = probed_price(options, file.scene, aim.from);
  aim.spent = wall() - begin;
  if (!interrupt_received()) choose(aim, options);
  return aim;
}

/// What the run itself makes of the band: one more mesh of the ladder.
std::string reached_text(const Aim& aim, const RunOptions& options, const fs::path& folder) {
  std::vector<PriceQuantity> quantities;
  for (const auto& quantity : aim.price.quantities) quantities.push_back(quantity.what);
  auto rungs = aim.price.rungs;
  for (auto& rung : rungs) rung.values.clear();
  for (const auto& quantity : aim.price.quantities)
    for (auto& rung : rungs) rung.values.push_back(quantity.at(rung.spec));
  std::vector<std::string> unused;
  auto reached = rung_in(folder, {aim.refine, Role::rung}, quantities, unused);
  const double seconds = reached.seconds;
  std::erase_if(rungs,
                [&](const Rung& rung) { return rung.spec.refine == aim.refine && rung.spec.role == Role::rung; });
  rungs.push_back(std::move(reached));
  const auto price = price_of(rungs, quantities, aim.price.dimension, unused);
  auto text = fmt::format("reached     {} for the run, {:+.0f} % of what was predicted; {}\n", about_time(seconds),
                          100 * (seconds / aim.predicted - 1), accuracy_text(price.accuracy(aim.refine)));
  if (options.seconds)
    text += fmt::format("            {} with the probes, {:+.0f} % of what was asked\n",
                        about_time(seconds + aim.spent), 100 * ((seconds + aim.spent) / *options.seconds - 1));
  return text;
}

}  // namespace

int aimed_run_command(const RunOptions& options) {
  Aim aim;
  catch_interrupts(options.quiet ? "" : "\nstopping\n");
  try {
    aim = aim_of(options);
  } catch (const std::exception& error) {
    return bad_input(trouble(error));
  }
  if (interrupt_received()) return exit_code::interrupted;
  auto chosen = options;
  chosen.overrides.push_back(fmt::format("fluid.size.refine={}", aim.refine));
  if (!options.quiet)
    fmt::print("chosen      refine {:g}, from {}\npredicted   {}, {}\n", aim.refine, aim.from,
               about_time(aim.predicted), accuracy_text(aim.price.accuracy(aim.refine)));
  const int code = run_command(chosen);
  if (options.quiet) return code;
  if (code == exit_code::interrupted)
    fmt::print("            continue with --refine {:g} --resume in place of --accuracy or --seconds\n", aim.refine);
  if (code == exit_code::done)
    fmt::print("{}", reached_text(aim, options, options.out.value_or(default_directory(options.scene))));
  return code;
}

}  // namespace splashdown::apps
