#include "apps/study/command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/files/folder_lock.hpp"
#include "apps/process/child_process.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/report/report.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/study/campaign/results.hpp"
#include "apps/study/chart.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/parallel.hpp"
#include "apps/study/run.hpp"
#include "apps/study/slurm.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

/// Tables, chart and report of what the runs have left behind.
void conclude(const Study& study, const std::vector<StudyRun>& runs, std::vector<Outcome>& outcomes,
              const fs::path& folder, bool quiet) {
  auto notes = measure(study, runs, folder, outcomes);
  write_tables(study, runs, outcomes, folder);
  leave_at_interrupt(quiet ? "" : "\nstopped while the report was drawn: the same command with --collect draws it\n");
  if (study.chart)
    if (auto note = draw_chart(study, runs, outcomes, folder)) notes.push_back(std::move(*note));
  write_report(folder);  // what it warns of, a chart that could not be drawn, is among the notes
  for (const auto& note : notes) fmt::print(stderr, "note: {}\n", note);
  if (quiet) return;
  const auto campaign = campaign_of(study, runs, outcomes);
  fmt::print("{}: {} runs: {}\n{}  files       {}/: report.html study.csv study.json{}\n",
             one_line(study.title.empty() ? folder.filename().string() : study.title), runs.size(),
             counts_text(outcomes), campaign ? campaign_text(*campaign, study) : "", folder.string(),
             fs::exists(folder / "study.svg") ? " study.svg study.png" : "");
}

int hand_to_slurm(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes,
                  const fs::path& folder, const StudyOptions& options) {
  if (std::ranges::all_of(outcomes, &Outcome::finished)) {
    if (!options.quiet) fmt::print("all runs are finished\n");
    return exit_code::done;
  }
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!outcomes[i].finished()) prepare(runs[i], folder / runs[i].name);
  const ArrayLimits limits{.at_a_time = options.jobs, .longest = longest_array(folder)};
  const auto scripts = slurm_scripts(study, runs, outcomes, folder, limits);
  const auto said = submit(study, scripts, folder);
  if (!options.quiet)
    fmt::print("{}\n  script      {}\n  see         squeue --me\n", said,
               (folder / (scripts.size() == 1 ? "study.sbatch" : "study-*.sbatch")).string());
  return exit_code::done;
}

std::string enough_text(const Study& study) {
  if (study.envelope)
    return fmt::format(
        "stopped: the envelope of {} has its runs; with more envelope.runs or less envelope.doubt the same command "
        "continues",
        study.envelope->limit);
  return fmt::format("stopped: the band of {} is narrow enough; with a smaller stop.width the same command continues",
                     study.stop->of);
}

RunnerEnd make_in_parallel(const Study& study, const std::vector<StudyRun>& runs, std::vector<Outcome>& outcomes,
                           const fs::path& folder, int jobs) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (!outcomes[i].finished()) prepare(runs[i], folder / runs[i].name);
  run_in_parallel(parallel_commands(study, runs, outcomes, folder), folder, jobs);
  outcomes = outcomes_in(study, runs, folder);
  RunnerEnd end;
  end.interrupted = interrupt_received();
  return end;
}

}  // namespace

int study_command(const StudyOptions& options) {
  Study study;
  std::vector<StudyRun> runs;
  try {
    auto plan = plan_study(options.study);
    study = std::move(plan.study);
    study.large = options.large;
    runs = std::move(plan.runs);
  } catch (const SceneError& error) {
    return bad_input(error.what());
  }
  const bool slurm = options.on == "slurm", parallel = options.on == "parallel";
  if ((slurm || parallel) && study.envelope)
    return bad_input(
        fmt::format("--on {}: hands over all runs at once, but [envelope] chooses each by those before it. "
                    "Leave --on out, or remove [envelope].",
                    options.on));
  if (parallel && !find_program("parallel"))
    return bad_input(
        "--on parallel: there is no GNU Parallel on this machine. Install the package parallel, or leave --on out.");
  if (slurm && !find_program("sbatch"))
    return bad_input("--on slurm: there is no sbatch on this machine. Install Slurm, or leave --on out.");

  // Absolute, because the runs of a cluster need not start here.
  const auto folder = fs::absolute(options.out.value_or(default_directory(options.study))).lexically_normal();
  if (const auto refused = unwritable(folder)) return bad_input(*refused);
  std::optional<FolderLock> lock;
  try {
    std::string foreign;
    for (const auto& message : foreign_places(runs, folder)) foreign += message + "\n";
    if (!foreign.empty()) return bad_input(foreign);
    make_study_folder(folder);
    lock.emplace(folder);
  } catch (const std::exception& error) {
    return bad_input(trouble(error));
  }
  auto outcomes = outcomes_in(study, runs, folder);
  if (slurm) {
    lock.reset();  // the job that gathers the results takes it
    try {
      return hand_to_slurm(study, runs, outcomes, folder, options);
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "error: {}\n", error.what());
      return exit_code::cannot_go_on;
    }
  }
  RunnerEnd end;
  if (!options.collect) {
    catch_interrupts();
    end = parallel ? make_in_parallel(study, runs, outcomes, folder, options.jobs)
                   : make_runs(study, runs, outcomes, folder, options.jobs, options.quiet);
  }
  conclude(study, runs, outcomes, folder, options.quiet);
  for (const auto& text : end.unable) fmt::print(stderr, "error: {}\n", text);
  if (end.interrupted && !options.quiet) fmt::print("stopped; the same command continues\n");
  if (end.enough && !options.quiet) fmt::print("{}\n", enough_text(study));
  return exit_code_of(outcomes, end.interrupted);
}

}  // namespace splashdown::apps
