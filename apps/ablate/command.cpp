#include "apps/ablate/command.hpp"

#include <fmt/format.h>

#include "apps/ablate/write.hpp"
#include "apps/files/csv.hpp"
#include "apps/files/folder_lock.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/report/report.hpp"
#include "apps/run/folder/folder.hpp"
#include "apps/scene/rules/problems.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/run.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char *table_file = "ablation.csv", *json_file = "ablation.json";

/// What stands in the way of it; empty: nothing.
std::string foreign_text(const AblationPlan& plan, const fs::path& folder) {
  std::string text;
  for (const auto& message : foreign_places(plan.runs, folder)) text += message + "\n";
  if (fs::exists(folder / "price.json"))
    text += fmt::format("{}: holds a price list. Use another --out.\n", folder.string());
  else if (fs::exists(folder / "study.json") && !fs::exists(folder / json_file))
    text += fmt::format("{}: holds a study. Use another --out.\n", folder.string());
  return text;
}

/// Tables, chart and page of what the runs have left behind.
void conclude(const AblationPlan& plan, const std::vector<Outcome>& outcomes, const fs::path& folder,
              const AblateOptions& options) {
  const double least = options.matters / 100;
  const auto ablation = ablation_of(plan, outcomes, folder, least);
  write_file_atomically(folder / table_file, ablation_csv(plan, ablation));
  write_file_atomically(folder / json_file, ablation_json(plan, ablation, least));
  leave_at_interrupt(options.quiet ? "" : "\nstopped while the chart was drawn: the same command draws it\n");
  auto notes = plan.notes;
  if (auto note = draw_ablation(plan, ablation, least, folder)) notes.push_back(std::move(*note));
  write_report(folder);
  for (const auto& note : notes) fmt::print(stderr, "note: {}\n", note);
  if (options.quiet) return;
  fmt::print("{}: {} runs: {}\n", one_line(plan.title.empty() ? folder.filename().string() : plan.title),
             plan.runs.size(), counts_text(outcomes));
  fmt::print("{}  files       {}/: report.html {} {}{}\n", ablation_text(plan, ablation), folder.string(), table_file,
             json_file, fs::exists(folder / "ablation.svg") ? " ablation.svg" : "");
}

}  // namespace

int ablate_command(const AblateOptions& options) {
  AblationPlan plan;
  std::optional<FolderLock> lock;
  const auto folder =
      fs::absolute(options.out.value_or(default_directory(options.scene).string() + "_ablate")).lexically_normal();
  try {
    plan = plan_ablation({.scene = options.scene,
                          .set = options.set,
                          .quantities = options.quantities,
                          .all = options.all,
                          .only = options.only});
    plan.study.large = options.large;
    if (options.threads || plan.dimension == 3) plan.study.threads = options.threads;
    if (const auto refused = unwritable(folder)) return bad_input(*refused);
    if (const auto foreign = foreign_text(plan, folder); !foreign.empty()) return bad_input(foreign);
    make_study_folder(folder);
    lock.emplace(folder);
    // From now on the folder is that of an ablation, whatever ends it.
    if (!fs::exists(folder / json_file)) write_file_atomically(folder / json_file, "{}\n");
  } catch (const std::exception& error) {
    return bad_input(trouble(error));
  }
  auto outcomes = outcomes_in(plan.study, plan.runs, folder);
  RunnerEnd end;
  if (!options.collect) {
    catch_interrupts();
    end = make_runs(plan.study, plan.runs, outcomes, folder, options.jobs, options.quiet);
  }
  conclude(plan, outcomes, folder, options);
  for (const auto& text : end.unable) fmt::print(stderr, "error: {}\n", text);
  if (end.interrupted && !options.quiet) fmt::print("stopped; the same command continues\n");
  return exit_code_of(outcomes, end.interrupted);
}

}  // namespace splashdown::apps
