#include "apps/price/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "apps/price/cost.hpp"
#include "apps/process/child_process.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/process/renewed_line.hpp"
#include "apps/quantity/names.hpp"
#include "apps/quantity/table.hpp"
#include "apps/run/progress.hpp"
#include "apps/scene/choose/refine.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/run.hpp"
#include "apps/study/table.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Axis refine_axis(const std::vector<RungSpec>& specs, const LadderOrder& order) {
  Axis axis;
  axis.name = axis.label = "refine";
  for (const auto& spec : specs) {
    const auto text = digits_of(spec.refine);
    AxisValue value{text, spec.refine, refined_by(order.refine_keys, spec.refine), {}};
    if (spec.role == Role::larger_tank) {
      value.text += "_larger_tank";
      value.set.insert(value.set.end(), order.larger_tank.begin(), order.larger_tank.end());
    }
    axis.values.push_back(std::move(value));
  }
  return axis;
}

bool same(const RungSpec& a, const RungSpec& b) {
  return a.role == b.role && digits_of(a.refine) == digits_of(b.refine);
}

std::string failure_text(const RungSpec& spec, const std::string& cause) {
  return fmt::format("refine {} did not reach its end: {}", digits_of(spec.refine), cause);
}

}  // namespace

std::string digits_of(double refine) { return fmt::format("{:.4g}", refine); }

std::vector<double> rung_refines(int rungs, double scene) {
  std::vector<double> refines;
  for (int k = 0; k < rungs; ++k) {
    const double exact = scene * 0.5 * std::pow(2., 0.5 * k);  // sqrt(2): twice the elements in the plane
    refines.push_back(std::stod(fmt::format("{:.3g}", exact)));
  }
  return refines;
}

std::vector<std::string> refined_by(const std::vector<std::string>& keys, double refine) {
  std::vector<std::string> set;
  for (const auto& key : keys) set.push_back(key + "=" + digits_of(refine));
  return set;
}

std::vector<std::string> refine_keys_of(const fs::path& scene, const std::vector<std::string>& set) {
  return refine_keys(read_scene(scene, set).scene);
}

std::optional<Scene> scene_at(const fs::path& scene, std::vector<std::string> set, double refine) {
  try {
    for (auto& word : refined_by(refine_keys_of(scene, set), refine)) set.push_back(std::move(word));
    return read_scene(scene, set).scene;
  } catch (const SceneError&) {
    return {};
  }
}

Ladder::Ladder(LadderOrder order, const std::vector<RungSpec>& possible)
    : order_(std::move(order)), possible_(possible), started_(now()) {
  study_.file = study_.scene = fs::absolute(order_.scene);
  study_.set = order_.set;
  study_.large = order_.large;
  study_.threads = order_.threads;
  study_.reports = false;  // the price list has a page of its own
  study_.axes = {refine_axis(possible, order_)};
  runs_ = expand(study_);
  try {
    resolve(study_, runs_);
  } catch (const SceneError& error) {
    auto messages = error.messages();
    messages.push_back(
        fmt::format("{}: the ladder begins at {} = {} and needs a scene there. Begin finer: --set "
                    "{}=X, about which the ladder is built.",
                    order_.scene.string(), order_.refine_keys.front(), digits_of(possible.front().refine),
                    order_.refine_keys.front()));
    throw SceneError(std::move(messages));
  }
}

bool Ladder::allow(const RungSpec& spec) {
  if (std::ranges::any_of(possible_, [&](const RungSpec& other) { return same(spec, other); })) return true;
  auto one = study_;
  one.axes = {refine_axis({spec}, order_)};
  auto runs = expand(one);
  try {
    resolve(one, runs);
  } catch (const SceneError&) {
    return false;
  }
  if (!foreign_places(runs, order_.folder).empty()) return false;
  possible_.push_back(spec);
  runs_.push_back(std::move(runs.front()));
  return true;
}

double Ladder::spent() const { return now() - started_; }

double Ladder::seconds_left() const { return order_.budget ? *order_.budget - spent() : HUGE_VAL; }

std::optional<double> Ladder::seconds_at(double refine) const {
  const RunCost cost(made_, order_.expected_nodes, order_.dimension);
  return cost.known() ? std::optional(cost.seconds(refine)) : std::nullopt;
}

const StudyRun& Ladder::run_of(const RungSpec& spec) const {
  const auto found = std::ranges::find_if(possible_, [&](const RungSpec& other) { return same(spec, other); });
  return runs_[static_cast<std::size_t>(found - possible_.begin())];
}

bool Ladder::affordable(const RungSpec& spec) const {
  const auto& run = run_of(spec);
  if (outcome_of(study_, run, order_.folder / run.name).finished()) return true;
  return seconds_at(spec.refine).value_or(0) <= seconds_left();
}

bool Ladder::climb(const RungSpec& spec, double most) {
  if (end_.interrupted) return false;
  const auto& run = run_of(spec);
  if (auto rung = read(run, spec)) {
    made_.push_back(std::move(*rung));
    return true;
  }
  if (const auto before = outcome_of(study_, run, order_.folder / run.name); before.finished()) {
    end_.notes.push_back(failure_text(spec, before.cause));
    return true;
  }
  if (!affordable(spec)) {
    end_.out_of_budget = true;
    return false;
  }
  if (!make(run, spec, most)) return false;
  if (auto rung = read(run, spec)) {
    say(fmt::format("refine {:<6} {:>8.3g} s  {:>9.3g} node-steps  {:>6.0f} MB{}", digits_of(spec.refine),
                    rung->seconds, rung->node_steps, rung->memory_mb,
                    spec.role == Role::rung ? "" : "  (" + word_of(spec.role) + ")"));
    made_.push_back(std::move(*rung));
  }
  return true;
}

double Ladder::part_made(const RungSpec& spec) const {
  const auto& run = run_of(spec);
  return quantity::read_summary(order_.folder / run.name).value("simulated_time", 0.) / run.stop;
}

bool Ladder::make(const StudyRun& run, const RungSpec& spec, double most) {
  const auto place = order_.folder / run.name, log = order_.folder / (run.name + ".log");
  prepare(run, place);
  fs::remove(log);
  auto study = study_;
  if (const double seconds = std::min(seconds_left(), most); seconds < HUGE_VAL)
    study.budget = std::max(seconds, 0.1);  // none is no budget
  ChildProcess process(command_of(study, run, place), log);
  const double begin = now();
  const auto expected = seconds_at(spec.refine);
  RenewedLine line(!order_.quiet && RenewedLine::is_terminal());
  std::optional<ChildProcess::End> ended;
  while (!(ended = process.end())) {
    if (interrupt_received() && !end_.interrupted) {
      end_.interrupted = true;
      process.ask_to_stop();
    }
    if (line.is_due())
      line.show(fmt::format("refine {}: {}{}", digits_of(spec.refine), clock_text(now() - begin),
                            expected ? " of about " + clock_text(*expected) : ""));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  line.clear();
  if (end_.interrupted) return false;
  if (ended->code == exit_code::interrupted) {
    end_.out_of_budget = true;
    return false;
  }
  const auto outcome = outcome_of(study_, run, place);
  if (outcome.status == Outcome::Status::converged) {
    fs::remove(log);
    return true;
  }
  end_.notes.push_back(failure_text(spec, outcome.cause.empty() ? last_line(log) : outcome.cause));
  return true;
}

std::optional<Rung> Ladder::read(const StudyRun& run, const RungSpec& spec) {
  const auto place = order_.folder / run.name;
  if (outcome_of(study_, run, place).status != Outcome::Status::converged) return {};
  return rung_in(place, spec, order_.quantities, end_.notes);
}

void Ladder::say(const std::string& text) const {
  if (order_.quiet) return;
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

Rung rung_in(const fs::path& folder, const RungSpec& spec, const std::vector<PriceQuantity>& quantities,
             std::vector<std::string>& notes) {
  const auto summary = quantity::read_summary(folder);
  Rung rung{.spec = spec, .folder = folder.filename().string(), .values = {}};
  rung.seconds = summary.value("wall_seconds", 0.);
  if (const auto setup = quantity::find_entry(summary, "phases.setup")) rung.setup_seconds = setup->numbers.front();
  if (const auto output = quantity::find_entry(summary, "phases.output")) rung.output_seconds = output->numbers.front();
  rung.steps = summary.value("steps", 0.);
  rung.memory_mb = summary.value("memory_mb", 0.);
  rung.node_steps = node_steps_in(folder);
  for (const auto& quantity : quantities) {
    std::string why;
    rung.values.push_back(value_in(folder, quantity, why));
    rung.told.push_back(told_error_in(folder, quantity));
    if (quantity.asked && !why.empty())
      notes.push_back(fmt::format("{} at refine {}: {}", quantity.name, digits_of(spec.refine), why));
  }
  return rung;
}

std::vector<std::string> larger_tank_of(const Scene& scene, const std::string& name) {
  if (!scene.tank)
    throw SceneError({name + ": --open-water: has no [tank] whose walls could be moved away. Leave --open-water out."});
  const auto d = scene.dimension;
  const auto text = [d](const Point& point) { return toml_list(std::vector<double>(point.data(), point.data() + d)); };
  const auto& old = *scene.tank;
  double level = old.min[d - 1];
  static const std::vector<Region> none;
  const auto& regions = scene.fluid ? scene.fluid->regions : none;
  for (const auto& region : regions)
    if (const auto* box = std::get_if<BoxRegion>(&region.shape)) level = std::max(level, box->max[d - 1]);
  Point low = old.min, high = old.max;
  for (int k = 0; k + 1 < d; ++k) {
    const double centre = 0.5 * (low[k] + high[k]), half = 0.5 * tank_growth * (high[k] - low[k]);
    low[k] = centre - half;
    high[k] = centre + half;
  }
  low[d - 1] = level - tank_growth * (level - low[d - 1]);
  std::vector<std::string> set = {"tank.min=" + text(low), "tank.max=" + text(high)};
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto* box = std::get_if<BoxRegion>(&regions[i].shape);
    if (!box) continue;
    Point from = box->min, to = box->max;
    for (int k = 0; k < d; ++k) {
      if (from[k] <= old.min[k]) from[k] = low[k];
      if (to[k] >= old.max[k]) to[k] = high[k];
    }
    set.push_back(fmt::format("fluid.region.{}.min={}", i, text(from)));
    set.push_back(fmt::format("fluid.region.{}.max={}", i, text(to)));
  }
  return set;
}

std::vector<RungSpec> possible_rungs(const std::vector<double>& refines, bool open_water) {
  std::vector<RungSpec> specs;
  for (const double refine : refines) specs.push_back({refine, Role::rung});
  for (const double refine : refines)
    for (const int k : {0, 1}) specs.push_back({replicate_refine(refine, k), Role::replicate});
  if (open_water)
    for (const double refine : refines) specs.push_back({refine, Role::larger_tank});
  return specs;
}

void climb_all(Ladder& ladder, const std::vector<double>& refines, bool open_water, bool replicates) {
  const auto beside = [&](double refine) {
    for (const int k : {0, 1})
      if (replicates && !ladder.climb({replicate_refine(refine, k), Role::replicate})) return;
    if (open_water) ladder.climb({refine, Role::larger_tank});
  };
  for (std::size_t k = 0; k < refines.size(); ++k) {
    // Before the finest: what a budget leaves out is better a rung than the scatter.
    if (k + 1 == refines.size() || !ladder.affordable({refines[k], Role::rung})) {
      beside(refines[k == 0 ? 0 : k - 1]);
      ladder.climb({refines[k], Role::rung});
      return;
    }
    if (!ladder.climb({refines[k], Role::rung})) return;
  }
}

}  // namespace splashdown::apps
