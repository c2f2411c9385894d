#include "apps/run/command.hpp"

#include <fmt/format.h>
#include <time.h>

#include <chrono>
#include <stdexcept>

#include "apps/check/questions.hpp"
#include "apps/check/start.hpp"
#include "apps/check/ties.hpp"
#include "apps/files/csv.hpp"
#include "apps/files/folder_lock.hpp"
#include "apps/files/run_files.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/process/renewed_line.hpp"
#include "apps/report/report.hpp"
#include "apps/run/closing.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/run/folder/resume.hpp"
#include "apps/run/next.hpp"
#include "apps/run/run.hpp"
#include "apps/run/threads.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/text/number_text.hpp"
#include "core/stopwatch.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

Progress::Style progress_style(bool quiet) {
  if (quiet) return Progress::Style::none;
  return RenewedLine::is_terminal() ? Progress::Style::terminal : Progress::Style::plain;
}

/// Throws SceneError for a stop time that the scene has no room for.
double stop_time(const RunOptions& options, const Scene& scene) {
  if (!options.until) return scene.time.end;
  if (*options.until > scene.time.end)
    throw SceneError(
        {fmt::format("--until {:g}: must not exceed time.end = {:g} s. Use --set time.end={:g} for a longer run.",
                     *options.until, scene.time.end, *options.until)});
  return *options.until;
}

/// Tables go before the checkpoint: a folder with tables and none is taken for a run that is lost.
void prepare_directory(const RunOptions& options, const fs::path& directory, const std::string& resolved,
                       bool resumed) {
  if (!resumed) {
    clear_earlier_run(directory);
    fs::remove_all(directory / "checkpoint");
  }
  write_resolved(directory, options.scene, resolved);
}

void say(const RunOptions& options, const std::string& text) {
  if (!options.quiet) fmt::print("{}\n", text);
}

/// Where, when and why; what was saved; what might help.
template <int d>
std::string failure_text(const LoopEnd& end, const Run<d>& run, const fs::path& directory) {
  const auto cure =
      !end.cure.empty() ? end.cure
      : run.loop().crawls()
          ? fmt::format("End the run earlier (--until {:.4g}), or keep walls farther apart than an element.",
                        0.99 * run.time())
          : std::string(
                "Smaller steps (--set time.cfl=0.25) or finer elements may help;\n"
                "--resume continues from there.");
  return fmt::format(
      "error: the simulation could not go on at t = {:.9g} s, step {}: {}\n"
      "The last good state is in {}. {}",
      run.time(), run.loop().steps, end.cause, (directory / "checkpoint").string(), cure);
}

/// Draws report.html from the files, and counts the time that it takes as the run's.
void report(Summary& summary, const RunOptions& options, const fs::path& directory) {
  const auto start = std::chrono::steady_clock::now();
  const double before = processor_seconds();
  for (const auto& warning : write_report(directory).warnings) say(options, "note: " + warning);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  summary.phases.emplace_back("report", seconds);
  summary.wall_seconds += seconds;
  summary.processor_seconds += processor_seconds() - before;
  write_summary(directory, summary);
}

/// Writes summary.json and report.html.
template <int d>
Summary conclude(const Run<d>& run, const LoopEnd& end, const Scene& scene, const RunOptions& options,
                 const fs::path& directory) {
  auto summary = run.summary(end);
  summary.scene = scene.title.empty() ? directory.filename().string() : scene.title;
  summary.command = command_of(options);
  for (const auto& text : summary.not_foreseen) say(options, "note: not known: " + text);
  complete(summary.next, options, scene, summary.wall_seconds);
  write_summary(directory, summary);
  if (options.no_report) return summary;
  const auto later = fmt::format("splashdown report {} draws it", directory.string());
  if (end.status == LoopEnd::Status::interrupted && interrupt_received()) {
    say(options, "no report: " + later);
    return summary;
  }
  leave_at_interrupt(options.quiet ? "" : "\nstopped while the report was drawn: " + later + "\n");
  report(summary, options, directory);
  return summary;
}

int exit_code_of(const LoopEnd& end) {
  switch (end.status) {
    case LoopEnd::Status::done:
      return exit_code::done;
    case LoopEnd::Status::interrupted:
      return exit_code::interrupted;
    case LoopEnd::Status::failed:
      break;
  }
  return exit_code::cannot_go_on;
}

template <int d>
int go(Run<d>& run, const Scene& scene, const RunOptions& options, const fs::path& directory) {
  const auto end = run.go();
  const auto summary = conclude(run, end, scene, options, directory);
  if (end.status == LoopEnd::Status::failed) fmt::print(stderr, "{}\n", failure_text(end, run, directory));
  if (options.quiet) return exit_code_of(end);
  fmt::print("{}", closing_text(summary, directory, RenewedLine::is_terminal() ? Ink::colour : Ink::plain));
  if (end.status == LoopEnd::Status::interrupted) fmt::print("stopped: {}; continue with --resume\n", end.cause);
  if (end.status == LoopEnd::Status::done && !options.no_report)
    fmt::print("next: open {} in a browser{}\n", (directory / "report.html").string(),
               fs::exists(directory / "frames.pvd") ? ", frames.pvd in ParaView" : "");
  return exit_code_of(end);
}

/// What a run begins with.
struct Start {
  SceneFile file;
  RunPlan plan;
  StoredCheckpoints from;
  bool resumes() const { return !from.good.empty(); }
};

/// Before main only the loader runs, and it waits for nothing: this thread's processor time is the time since then.
std::chrono::steady_clock::time_point process_start() {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::chrono::steady_clock::now() - std::chrono::seconds(used.tv_sec) - std::chrono::nanoseconds(used.tv_nsec);
}

/// Throws SceneError.
Start read_start(const RunOptions& options) {
  Start start;
  auto& plan = start.plan;
  const bool chosen_before = options.accuracy || options.seconds;  // which took its own time
  plan.started = chosen_before ? std::chrono::steady_clock::now() : process_start();
  plan.processor_started = chosen_before ? processor_seconds() : 0;
  plan.budget = options.budget;
  plan.directory = options.out.value_or(default_directory(options.scene));
  start.file = read_scene(options.scene, options.overrides);
  plan.stop = stop_time(options, start.file.scene);
  plan.resolved = start.file.resolved;
  if (options.resume) start.from = find_checkpoints(plan.directory, plan.resolved);
  if (const auto refused = unwritable(plan.directory)) throw SceneError({*refused});
  if (!start.resumes() && !options.force)
    if (const auto foreign = foreign_results(plan.directory, options.scene, plan.resolved))
      throw SceneError({*foreign});
  if (start.resumes() && start.from.good.front().state.time > plan.stop)
    throw SceneError(
        {fmt::format("--resume: the run is at t = {:g} s already and cannot stop at {:g} s. Use a later "
                     "stop, or start anew "
                     "without --resume.",
                     start.from.good.front().state.time, plan.stop)});
  return start;
}

/// What the scene may not mean, and whether it is larger than anybody asked for. Throws SceneError.
template <int d>
void ask(const SceneFile& file, const Cost& cost, const RunOptions& options) {
  const auto& scene = file.scene;
  refuse_contradicting_ties<d>(file);
  if (!options.quiet) {
    for (const auto& note : ties_notes<d>(scene)) fmt::print("note: {}\n", note);
    for (const auto& question : questions<d>(scene, cost)) fmt::print(stderr, "question: {}\n", question);
  }
  if (const auto why = too_large(cost); why && !options.large)
    throw SceneError({fmt::format(
        "{}: {}. Use larger element sizes, mind the units (splashdown check says more), or run it with --large.",
        options.scene.string(), *why)});
  if (options.budget && cost.seconds_to_start > *options.budget)
    fmt::print(stderr, "note: the first mesh takes about {}, more than the budget of {:g} s\n",
               with_unit(cost.seconds_to_start, "s"), *options.budget);
}

/// The budget was spent before the first step.
struct SpentAtStart {};

/// Throws SceneError for what the scene's parts refuse, within seconds for most, and SpentAtStart.
template <int d>
World<d> build(const Scene& scene, const Cost& cost, const RunOptions& options, const RunPlan& plan) {
  std::function<void()> meanwhile;
  if (plan.budget)
    meanwhile = [&] {
      if (std::chrono::steady_clock::now() - plan.started > std::chrono::duration<double>(*plan.budget))
        throw SpentAtStart{};
    };
  try {
    World<d> world;
    const auto doubtful = check_start<d>(scene, cost, options.large ? Doubt::accept : Doubt::leave);
    tell_gaps<d>(scene, doubtful, [&] { world = build_world<d>(scene, meanwhile); });
    return world;
  } catch (const std::exception& error) {
    throw SceneError({fmt::format("{}: {}", options.scene.string(), error.what())});
  }
}

/// From the newest checkpoint that the world takes. Throws SceneError, and nothing is changed, if it takes none.
template <int d>
void resume(Run<d>& run, const Start& start, const RunOptions& options) {
  auto reasons = start.from.bad;
  for (const auto& [file, state] : start.from.good) {
    try {
      run.resume(state);
    } catch (const std::exception& error) {
      reasons.push_back(file.string() + " " + error.what());
      continue;
    }
    for (const auto& reason : reasons) fmt::print(stderr, "note: {}\n", reason);
    if (!reasons.empty())
      fmt::print(stderr, "note: continuing from the checkpoint before, {}, t = {:.6g} s\n", file.string(), run.time());
    return say(options, fmt::format("continuing at t = {:.6g} s, step {}", run.time(), run.loop().steps));
  }
  throw SceneError(unusable(start.plan.directory, reasons));
}

/// What could be saved of a run whose folder went away, told.
template <int d>
int tell_loss(Run<d>& run, const FilesLost& loss, const RunOptions& options, const std::string& resolved) {
  fmt::print(stderr, "error: {}, at t = {:.9g} s, step {}.\n", loss.what(), run.time(), run.loop().steps);
  if (const auto folder = run.rescue()) {
    write_resolved(*folder, options.scene, resolved);
    fmt::print(stderr,
               "Tables and checkpoint until then are saved in {0}, without frames and pictures; --out {0} --resume "
               "continues there.\n",
               folder->string());
  } else {
    fmt::print(stderr, "They could not be saved anywhere else: what the run has made since its start is lost.\n");
  }
  return exit_code::cannot_go_on;
}

template <int d>
int run_scene(const RunOptions& options, Start start) {
  const auto& scene = start.file.scene;
  const auto directory = start.plan.directory;
  World<d> world;
  try {
    const auto cost = predicted_cost<d>(scene);
    ask<d>(start.file, cost, options);
    world = build<d>(scene, cost, options, start.plan);
  } catch (const SceneError& error) {
    return bad_input(error.what());
  } catch (const std::invalid_argument& error) {  // what one of the scene's parts refuses
    return bad_input(fmt::format("{}: {}", options.scene.string(), error.what()));
  } catch (const SpentAtStart&) {
    fmt::print(stderr, "stopped: the budget of {:g} s was spent before the first mesh was ready; nothing is written\n",
               *options.budget);
    return exit_code::interrupted;
  }
  Progress progress(progress_style(options.quiet));
  std::optional<FolderLock> lock;
  try {
    fs::create_directories(directory);
    lock.emplace(directory);
  } catch (const std::exception& error) {
    return bad_input(trouble(error));
  }
  try {
    Run<d> run(scene, std::move(world), recorder_settings<d>(scene, directory), start.plan, progress);
    try {
      if (start.resumes()) resume(run, start, options);
      prepare_directory(options, directory, start.file.resolved, start.resumes());
    } catch (const std::exception& error) {
      return bad_input(trouble(error));
    }
    if (options.resume && !start.resumes()) say(options, "no checkpoint found: starting from the beginning");
    catch_interrupts(options.quiet ? ""
                                   : "\nstopping after this step; once more stops at once, without a checkpoint\n");
    try {
      return go(run, scene, options, directory);
    } catch (const FilesLost& loss) {
      progress.clear();
      return tell_loss(run, loss, options, start.file.resolved);
    }
  } catch (const std::exception& error) {
    progress.clear();
    fmt::print(stderr, "error: {}\n{}\n", trouble(error),
               fs::exists(directory / "checkpoint" / "state")
                   ? fmt::format("The last good state is in {}; --resume continues from there.",
                                 (directory / "checkpoint").string())
                   : "No state was saved.");
    return exit_code::cannot_go_on;
  }
}

}  // namespace

int run_command(const RunOptions& options) {
  Start start;
  try {
    start = read_start(options);
  } catch (const SceneError& error) {
    return bad_input(error.what());
  }
  for (const auto& note : start.file.notes) say(options, "note: " + note);
  for (const auto& size : start.file.chosen) say(options, "chosen: " + size);
  set_threads(options.threads, start.file.scene.dimension);
  return start.file.scene.dimension == 2 ? run_scene<2>(options, std::move(start))
                                         : run_scene<3>(options, std::move(start));
}

}  // namespace splashdown::apps
