#include "apps/run/run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "apps/process/interrupt.hpp"
#include "apps/run/expectations.hpp"
#include "apps/run/foreseen.hpp"
#include "apps/run/held.hpp"
#include "apps/scene/numbers.hpp"
#include "apps/scene/scales.hpp"
#include "apps/statistics/verdict/limits.hpp"
#include "apps/statistics/verdict/verdict.hpp"
#include "core/stopwatch.hpp"

namespace splashdown::apps {
namespace {

std::map<std::string, double> as_map(const std::vector<std::pair<std::string, double>>& phases) {
  std::map<std::string, double> result;
  for (const auto& [name, seconds] : phases) result[name] += seconds;
  return result;
}

/// Largest resident set of this process. Linux counts in units of 1024 bytes (getrusage(2)).
double memory_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 * 1e-6;
}

double sum(const std::map<std::string, double>& phases) {
  double total = 0;
  for (const auto& [name, seconds] : phases) total += seconds;
  return total;
}

const char* status_word(const LoopEnd& end) {
  switch (end.status) {
    case LoopEnd::Status::done:
      return "done";
    case LoopEnd::Status::interrupted:
      return "interrupted";
    case LoopEnd::Status::failed:
      break;
  }
  return "failed";
}

}  // namespace

template <int d>
Run<d>::Run(const Scene& scene, World<d> world, RecorderSettings<d> settings, RunPlan plan, Progress& progress)
    : scene_(scene),
      simulation_(scene, std::move(world)),
      recorder_(std::move(settings)),
      plan_(std::move(plan)),
      progress_(progress) {
  setup_seconds_ = seconds_since(plan_.started);
  phases_at_start_ = as_map(simulation_.stepper().phase_seconds());
}

template <int d>
void Run<d>::resume(const Checkpoint& from) {
  const Stopwatch charge(setup_seconds_);
  put_back(from, simulation_.stepper(), loop_);
  recorder_.load(from.recorder);
  if (simulation_.world().bodies && from.loop.steps > 0 && recorder_.bodies() != simulation_.world().bodies->size())
    throw std::runtime_error("holds records of other bodies than the scene");
  wall_before_ = from.wall_seconds;
  processor_before_ = from.processor_seconds;
  phases_before_ = from.phases;
  phases_at_start_ = as_map(simulation_.stepper().phase_seconds());
  last_checkpoint_ = Clock::now();  // the one it came from
}

template <int d>
LoopEnd Run<d>::go() {
  const auto end = run_loop(simulation_.stepper(), loop_, plan_.stop, *this);
  progress_.clear();
  recorder_.check_files();
  const Stopwatch charge(output_seconds_);
  if (end.status == LoopEnd::Status::done) recorder_.snapshot("end", last_input_);
  recorder_.finish();
  return end;
}

template <int d>
void Run<d>::record(const StepMade& step) {
  const Stopwatch charge(output_seconds_);
  recorder_.check_files();  // before anything of this step is counted: what is rescued can be continued
  last_input_ = simulation_.known(step);
  last_input_.wall_seconds = wall_seconds();
  recorder_.record(last_input_);
  ProgressPoint point{
      .time = step.time, .stop = plan_.stop, .dt = step.dt, .steps = loop_.steps, .nodes = {}, .passes = {}};
  if (simulation_.world().fluid) point.nodes = simulation_.world().fluid->points().size();
  if (scene_.coupling) point.passes = step.report.passes;
  progress_.show(point);
}

template <int d>
void Run<d>::refused(double time, double dt, const coupling::StepReport& why) {
  recorder_.refused({time, dt, why.pass_residuals});
  if (refused_at_ == time) return;  // the same step, halved once more
  refused_at_ = time;
  progress_.say(
      fmt::format("step refused at t = {:.6g} s, dt = {:.3g} s, tried again with half: {}", time, dt, why.cause));
}

template <int d>
bool Run<d>::checkpoint_due() {
  return !last_checkpoint_ || seconds_since(*last_checkpoint_) >= scene_.output.checkpoint;
}

template <int d>
void Run<d>::checkpoint() {
  const Stopwatch charge(output_seconds_);
  recorder_.check_files();
  try {
    write_checkpoint(plan_.directory / "checkpoint", present());
  } catch (const std::exception&) {
    recorder_.check_files();  // the folder may have gone meanwhile
    throw;
  }
  last_checkpoint_ = Clock::now();
}

template <int d>
Checkpoint Run<d>::present() {
  std::ostringstream stepper, recorder;
  simulation_.stepper().save(stepper);
  recorder_.save(recorder);
  return {.scene = plan_.resolved,
          .loop = loop_,
          .time = time(),
          .wall_seconds = wall_seconds(),
          .processor_seconds = own_processor_seconds(),
          .phases = phases(),
          .stepper = std::move(stepper).str(),
          .recorder = std::move(recorder).str()};
}

template <int d>
std::optional<std::filesystem::path> Run<d>::rescue() {
  namespace fs = std::filesystem;
  const auto name = fs::absolute(plan_.directory).lexically_normal();
  for (const auto& place : {name, fs::temp_directory_path() / name.filename()}) try {
      auto folder = fs::path(place.string() + ".rescued");
      for (int n = 2; fs::exists(folder); ++n) folder = fmt::format("{}.rescued{}", place.string(), n);
      fs::create_directories(folder);
      recorder_.copy_tables(folder);
      write_checkpoint(folder / "checkpoint", present());
      return folder;
    } catch (const std::exception&) {  // a disk that is full or gone: the next place
    }
  return {};
}

template <int d>
std::optional<std::string> Run<d>::interruption() {
  if (const char* signal = interrupt_received()) return signal;
  if (plan_.budget && seconds_since(plan_.started) >= *plan_.budget)
    return fmt::format("the budget of {:g} s is spent", *plan_.budget);
  return {};
}

template <int d>
double Run<d>::wall_seconds() const {
  return wall_before_ + seconds_since(plan_.started);
}

template <int d>
double Run<d>::own_processor_seconds() const {
  return processor_before_ + processor_seconds() - plan_.processor_started;
}

template <int d>
std::map<std::string, double> Run<d>::phases() const {
  auto result = phases_before_;
  for (const auto& [name, seconds] : simulation_.stepper().phase_seconds()) result[name] += seconds;
  for (const auto& [name, seconds] : phases_at_start_) result[name] -= seconds;
  result["setup"] += setup_seconds_;
  result["output"] += output_seconds_;
  result["other"] = 0;
  result["other"] = std::max(0., wall_seconds() - sum(result));
  return result;
}

template <int d>
void Run<d>::released(double time, const std::string& cause) {
  progress_.say(
      fmt::format("at t = {:.6g} s no smaller step helped; the node in question flies on as a drop: {}", time, cause));
}

template <int d>
Summary Run<d>::summary(const LoopEnd& end) const {
  Summary s;
  s.status = status_word(end);
  s.cause = end.cause;
  s.cure = end.cure;
  s.simulated_time = time();
  s.steps = loop_.steps;
  s.wall_seconds = wall_seconds();
  s.processor_seconds = own_processor_seconds();
  s.memory_mb = memory_mb();
  s.rejected_causes = loop_.rejected;
  for (const auto& [cause, count] : loop_.rejected) s.rejected_steps += count;
  s.released_fragments = loop_.released;
  const auto spent = phases();
  s.phases.assign(spent.begin(), spent.end());
  for (const auto& note : effect_notes<d>(scene_)) {
    const auto found = spent.find(note.name);
    if (note.active)
      s.effects.push_back({note.name, found == spent.end() ? 0 : found->second, note.reason});
    else
      s.inactive_effects.push_back({note.name, note.reason});
  }
  if (scene_.coupling) {
    auto& coupling = s.coupling.emplace();
    coupling.scheme = scene_.coupling->scheme;
    coupling.interface_term = scene_.coupling->interface_term;
    coupling.rejected_causes = s.rejected_causes;
    coupling.rejected_steps = s.rejected_steps;
  }
  auto known = foreseen<d>(scene_);
  s.foreseen = std::move(known.bodies);
  s.not_foreseen = std::move(known.untold);
  s.still_water = still_water<d>(scene_);
  recorder_.summarise(s);
  s.expected = expectations_of(scene_);
  mark_held<d>(scene_, last_input_.time + 0.5 * last_input_.dt, s);
  judge(s);
  s.limits = answered(scene_.limits, numbers_of(scene_), s, scene_.time.end);
  return s;
}

template class Run<2>;
template class Run<3>;

}  // namespace splashdown::apps
