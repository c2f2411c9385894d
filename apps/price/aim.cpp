// run --accuracy and run --seconds: which mesh that is, and what came of it.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/check/cost.hpp"
#include "apps/files/folder_lock.hpp"
#include "apps/files/run_files.hpp"
#include "apps/price/advice.hpp"
#include "apps/price/command.hpp"
#include "apps/price/cost.hpp"
#include "apps/price/means/mean_run.hpp"
#include "apps/price/probes.hpp"
#include "apps/price/write.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/report/report.hpp"
#include "apps/run/command.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/scene/choose/refine.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/statistics/verdict/limits.hpp"
#include "apps/study/folder.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

// Probes are the scene's refinement times powers of sqrt(2), and begin at a quarter of it where the time allows.
constexpr ProbeRange probe_range{-8, 8};
constexpr int usual_first = -4;
double probe_factor(int k) { return std::pow(2., 0.5 * k); }
/// What a run of it has: one that was made on a mesh that is chosen is not made again.
double as_written(double refine) { return std::stod(digits_of(refine)); }
/// An order can be refused with three meshes, and found with four.
constexpr int probes_for_accuracy = 4, last_for_accuracy = usual_first + probes_for_accuracy - 1;
/// At most, of what `check` says before any run: steps of a long run are those of its impact.
constexpr double guess_is_off_by = 20;

/// A price, in words where it is from, and the folder with its runs.
struct Source {
  Price price;
  std::string from;
  fs::path folder;
};

struct Aim : Source {
  double begun = 0;   ///< by wall()
  double spent = 0;   ///< wall seconds of probes
  double report = 0;  ///< wall seconds that drawing the report takes
  double refine = 1;
  double predicted = 0;  ///< wall seconds
  /// Of a mean of several runs: how many, and the relative band that is expected of it.
  int runs = 1;
  std::optional<Decided> band = {};
};

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The price list of this very scene, if somebody has made one. Throws SceneError if the one that was named is another's.
std::optional<Source> listed_price(const RunOptions& options) {
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
  return Source{std::move(*price), file.string(), folder};
}

/// Meshes that the scene allows, about its own.
ProbeRange allowed_probes(const RunOptions& options, double own) {
  auto range = probe_range;
  const auto allowed = [&](int k) {
    return scene_at(options.scene, options.overrides, own * probe_factor(k)).has_value();
  };
  while (range.coarsest < usual_first && !allowed(range.coarsest)) ++range.coarsest;
  while (range.finest > usual_first + 1 && !allowed(range.finest)) --range.finest;
  return range;
}

/// Throws SceneError: with no run of it there is nothing to choose by.
[[noreturn]] void refuse_without_probes(const RunOptions& options, const Ladder& ladder, double refine) {
  if (options.seconds && ladder.end().out_of_budget)
    throw SceneError(
        {fmt::format("--seconds {:g}: is too short for {}: at refine {:.3g} it did not reach its end in that "
                     "time. Use more seconds, or a shorter run: --set time.end=X.",
                     *options.seconds, options.scene.string(), refine)});
  throw SceneError(
      {fmt::format("{}: no coarse run of it reached its end, so nothing is known of its price. Use "
                   "--refine, or mend its sizes.",
                   options.scene.string())});
}

/// Coarse runs go beside the folder of the run. Throws SceneError.
fs::path probe_folder(const RunOptions& options) {
  const auto folder =
      fs::absolute(options.out.value_or(default_directory(options.scene)).string() + "_probe").lexically_normal();
  if (const auto refused = unwritable(folder)) throw SceneError({*refused});
  return folder;
}

LadderOrder probe_order(const RunOptions& options, const Scene& scene) {
  LadderOrder order;
  order.scene = options.scene;
  order.folder = probe_folder(options);
  order.set = options.overrides;
  order.refine_keys = refine_keys_of(order.scene, order.set);
  order.threads = options.threads;
  order.budget = options.seconds;
  order.large = options.large;
  order.quiet = options.quiet;
  order.dimension = scene.dimension;
  order.quantities = default_quantities(scene);
  return order;
}

/// Says what is about to be made, for how long at most, and of what time.
void announce(const PlannedProbe& probe, double refine, const RunOptions& options) {
  if (options.quiet) return;
  const auto time = fmt::format("{} expected, {} at most", about_time(probe.expected), about_time(probe.most));
  if (probe.is_run)
    fmt::print("run         at refine {}, by check's guess alone: coarse runs would take more than a third of {}; {}\n",
               digits_of(refine), about_time(*options.seconds), time);
  else
    fmt::print("coarse run  at refine {}: {}, with all others a third of {}\n", digits_of(refine), time,
               about_time(*options.seconds));
  std::fflush(stdout);
}

/// The mesh that was begun last.
int climb_by(ProbePlan& plan, Ladder& ladder, const RunOptions& options, const std::function<double(int)>& refine,
             std::string& from) {
  const auto predicted = [&](int k) { return ladder.seconds_at(refine(k)).value_or(0); };
  ProbesMade made;
  int last = usual_first;
  while (const auto probe = plan.next(made, predicted)) {
    last = probe->mesh;
    const RungSpec spec{refine(last), Role::rung};
    announce(*probe, spec.refine, options);
    const double before = ladder.spent();
    const auto count = ladder.made().size();
    const bool goes_on = ladder.climb(spec, probe->most);
    if (probe->is_run) from = "check's guess alone";
    if (!goes_on && (probe->is_run || interrupt_received())) return last;
    if (!goes_on)
      plan.stopped(ladder.spent() - before, ladder.part_made(spec));
    else if (ladder.made().size() == count)
      plan.failed();
    made = {static_cast<int>(ladder.made().size()), goes_on ? last : made.finest, ladder.spent()};
  }
  return last;
}

/// Coarse runs beside the run's folder.
Source probed_price(const RunOptions& options, const Scene& scene) {
  const double own = refine_of(scene);
  const auto refine = [&](int k) { return as_written(own * probe_factor(k)); };
  const auto range = allowed_probes(options, own);
  auto order = probe_order(options, scene);
  order.expected_nodes =
      expected_nodes(options.scene, options.overrides, refine(range.coarsest),
                     farthest_extrapolation * refine(options.seconds ? range.finest : last_for_accuracy),
                     guess_is_off_by * options.seconds.value_or(HUGE_VAL));
  std::vector<RungSpec> possible;
  for (int k = range.coarsest; k <= range.finest; ++k) possible.push_back({refine(k), Role::rung});
  Ladder ladder(order, possible);
  make_study_folder(order.folder);
  const FolderLock lock(order.folder);
  auto from = fmt::format("coarse runs in {}", order.folder.string());
  int last = usual_first;
  if (options.seconds) {
    ProbePlan plan(*options.seconds,
                   {range, usual_first,
                    [&](int k) { return predicted_seconds(*scene_at(options.scene, options.overrides, refine(k))); }});
    last = climb_by(plan, ladder, options, refine, from);
  } else {
    while (ladder.climb({refine(last), Role::rung}) && last < std::min(last_for_accuracy, range.finest)) ++last;
  }
  if (ladder.made().empty() && !interrupt_received()) refuse_without_probes(options, ladder, refine(last));
  std::vector<std::string> unused;
  Source source{price_of(ladder.made(), order.quantities, scene.dimension, unused), from, order.folder};
  source.price.expected_nodes = std::move(order.expected_nodes);
  return source;
}

/// What drawing a report takes, by doing so for the finest run that there is; it depends little on the mesh.
double report_seconds(const Source& source) {
  const auto& [price, from, folder] = source;
  const auto finest = std::ranges::find_if(price.rungs, [&](const Rung& rung) {
    return rung.spec.role == Role::rung && rung.spec.refine == price.finest();
  });
  if (finest == price.rungs.end() || !fs::exists(folder / finest->folder / "summary.json")) return 0;
  const double begin = wall();
  try {
    write_report(folder / finest->folder);
  } catch (const std::exception&) {  // the run itself will say why
  }
  return wall() - begin;
}

std::string accuracy_text(const std::optional<std::pair<double, std::string>>& accuracy) {
  return accuracy ? fmt::format("a band of {:.2g} % ({})", 100 * accuracy->first, accuracy->second)
                  : "a band that is not known: too few meshes";
}

/// With those that have no band.
std::string reached_accuracy_text(const Price& price, const RungSpec& run) {
  const auto accuracy = price.reached(run);
  const auto without = price.without_band(run);
  if (!accuracy || without.empty()) return accuracy_text(accuracy);
  return fmt::format("{}; none yet for {}: on too few meshes", accuracy_text(accuracy), fmt::join(without, ", "));
}

/// A run whose files can be taken over.
bool is_made(const Source& source, const Rung& rung) {
  return rung.spec.role == Role::rung && fs::exists(source.folder / rung.folder / "checkpoint");
}

/// The finest mesh whose run takes no longer than what is left, or one whose run is there and took no longer than was asked.
double refine_in(const Aim& aim, double asked) {
  double refine = *aim.price.refine_in(std::max(asked - aim.spent - aim.report, 0.));
  for (const Rung& rung : aim.price.rungs)
    if (is_made(aim, rung) && rung.seconds <= asked) refine = std::max(refine, rung.spec.refine);
  return refine;
}

/// A mean of several runs takes the place of the finest mesh where its band is narrower by this: it is told with fewer words.
constexpr double narrower = 0.8;

void choose_by_seconds(Aim& aim, double asked) {
  aim.refine = as_written(refine_in(aim, asked));
  aim.predicted = *aim.price.seconds(aim.refine) + aim.report;
  aim.band = aim.price.accuracy(aim.refine);
  const auto mean = mean_in(aim.price, asked - aim.spent - aim.report);
  if (!mean || !aim.band || mean->band > narrower * aim.band->first) return;
  aim.refine = as_written(1 / mean->runs[mean->mean].h);
  aim.runs = mean->runs[mean->mean].runs;
  aim.predicted = mean->missing_seconds + aim.report;
  aim.band->first = mean->band;
}

/// Throws SceneError if neither a mesh nor a mean gets there.
void choose_by_accuracy(Aim& aim, const RunOptions& options) {
  const auto& price = aim.price;
  const double wanted = *options.accuracy / 100;
  if (const auto row = price.cheapest_for(wanted)) {
    aim.refine = as_written(*row->refine);
    aim.runs = row->runs;
    aim.predicted = *row->seconds + aim.report;
    aim.band = row->runs > 1 ? Decided{wanted, row->decided_by} : price.accuracy(aim.refine);
    return;
  }
  const double far = farthest_extrapolation * price.finest();
  const auto list = aim.from.ends_with(price_file) ? aim.folder : fs::path();
  throw SceneError(
      {fmt::format("--accuracy {:g}%: up to refine {:.3g}, {:g} times the finest mesh made, the best is {}. Use a "
                   "larger value; for this one: {}.",
                   *options.accuracy, far, farthest_extrapolation, accuracy_text(price.accuracy(far)),
                   advice_for(price, {options.scene, options.overrides, wanted, list}))});
}

/// Throws SceneError.
Aim aim_of(const RunOptions& options) {
  const auto file = read_scene(options.scene, options.overrides);
  if (refine_keys(file.scene).empty())
    throw SceneError(
        {fmt::format("{}: has no [fluid] and no [body.elastic], so there is no mesh to choose. Leave --accuracy and "
                     "--seconds out.",
                     options.scene.string())});
  if (const auto refused = unwritable(options.out.value_or(default_directory(options.scene))))
    throw SceneError({*refused});
  const double begin = wall();
  auto listed = listed_price(options);
  if (!listed && options.seconds && !file.scene.has_fluid())
    throw SceneError(
        {fmt::format("--seconds {:g}: without a fluid a mesh is chosen by a price list alone. Make it with "
                     "splashdown price {}.",
                     *options.seconds, options.scene.string())});
  Aim aim{listed ? std::move(*listed) : probed_price(options, file.scene)};
  aim.begun = begin;
  if (interrupt_received()) return aim;
  if (!options.no_report) aim.report = report_seconds(aim);
  aim.spent = wall() - begin;
  if (options.seconds)
    choose_by_seconds(aim, *options.seconds);
  else
    choose_by_accuracy(aim, options);
  return aim;
}

/// What the run itself makes of the band: one more mesh of the ladder.
std::string reached_text(const Aim& aim, const RunOptions& options, const fs::path& folder) {
  const auto quantities = quantities_of(aim.price);
  auto rungs = measured_runs(aim.price);
  std::vector<std::string> unused;
  auto reached = rung_in(folder, {aim.refine, Role::rung}, quantities, unused);
  const double seconds = reached.seconds, all = wall() - aim.begun;
  std::erase_if(rungs,
                [&](const Rung& rung) { return rung.spec.refine == aim.refine && rung.spec.role == Role::rung; });
  rungs.push_back(std::move(reached));
  const auto price = price_of(rungs, quantities, aim.price.dimension, unused);
  auto text = fmt::format("reached     {} for the run, {:+.0f} % of what was predicted; {}\n", about_time(seconds),
                          100 * (seconds / aim.predicted - 1), reached_accuracy_text(price, {aim.refine, Role::rung}));
  if (options.seconds)
    text += fmt::format("            {} with the probes, {:+.0f} % of what was asked\n", about_time(all),
                        100 * (all / *options.seconds - 1));
  return text;
}

/// A run on this mesh was made already: its files, but for a report, in the folder of the run.
bool taken_over(const Aim& aim, const RunOptions& options, const fs::path& folder) {
  const auto made = std::ranges::find_if(
      aim.price.rungs, [&](const Rung& rung) { return is_made(aim, rung) && rung.spec.refine == aim.refine; });
  if (made == aim.price.rungs.end()) return false;
  const auto resolved = read_scene(options.scene, options.overrides).resolved;
  if (!options.force && foreign_results(folder, options.scene, resolved)) return false;
  fs::create_directories(folder);
  const FolderLock lock(folder);
  clear_earlier_run(folder);
  fs::remove_all(folder / "checkpoint");
  fs::copy(aim.folder / made->folder, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  return true;
}

/// The other runs of the mean; in words what came of them, empty if it was stopped.
std::string mean_text(const Aim& aim, const RunOptions& options, const fs::path& folder) {
  MeanOrder order{.options = options,
                  .folder = folder,
                  .price = aim.price,
                  .accuracy = options.accuracy ? *options.accuracy / 100 : aim.band->first,
                  .seconds = {}};
  if (options.seconds) order.seconds = *options.seconds - (wall() - aim.begun) - aim.report;
  const auto found = make_mean(order);
  if (!found) return {};
  if (!options.no_report) write_report(folder);
  const double all = wall() - aim.begun;
  std::string limits;
  for (const auto& limit : found->limits) limits += fmt::format("limit       {}\n", text_of(limit));
  return limits +
         fmt::format(
             "reached     {} in all, {} of them for runs in {}/{}; the mean of {} runs at refine {:.3g} has {}{}\n"
             "            it stands in summary.json, mean_of_runs\n",
             about_time(all), about_time(found->seconds), folder.string(), replicates_folder, found->runs,
             found->refine, accuracy_text(found->band),
             found->band.first > order.accuracy ? ", wider than was planned" : "");
}

int tell_mean(const Aim& aim, const RunOptions& options, const fs::path& folder) {
  catch_interrupts(options.quiet ? "" : "\nstopping: the run saves its checkpoint\n");  // the report left at one
  try {
    const auto text = mean_text(aim, options, folder);
    if (!options.quiet)
      fmt::print("{}", text.empty() ? "stopped: the same command goes on with the other runs\n" : text);
    return text.empty() ? exit_code::interrupted : exit_code::done;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: the run is done, its mean with others is not: {}\n", trouble(error));
    return exit_code::cannot_go_on;
  }
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
  for (const auto& key : refine_keys_of(options.scene, options.overrides))
    chosen.overrides.push_back(fmt::format("{} (refine {:g}): {}={}",
                                           options.accuracy ? fmt::format("--accuracy {:g}%", *options.accuracy)
                                                            : fmt::format("--seconds {:g}", *options.seconds),
                                           aim.refine, key, aim.refine));
  const auto folder = options.out.value_or(default_directory(options.scene));
  try {
    chosen.resume = taken_over(aim, chosen, folder);
  } catch (const std::exception& error) {
    return bad_input(trouble(error));
  }
  if (!options.quiet)
    fmt::print("chosen      {}refine {:g}, from {}\npredicted   {}, {}\n",
               aim.runs > 1 ? fmt::format("the mean of {} runs at ", aim.runs) : "", aim.refine, aim.from,
               about_time(aim.predicted), accuracy_text(aim.band));
  const int code = run_command(chosen);
  if (code == exit_code::done && aim.runs > 1) return tell_mean(aim, options, folder);
  if (options.quiet) return code;
  if (code == exit_code::interrupted)
    fmt::print("            continue with --refine {:g} --resume in place of --accuracy or --seconds\n", aim.refine);
  if (code == exit_code::done) fmt::print("{}", reached_text(aim, options, folder));
  return code;
}

}  // namespace splashdown::apps
