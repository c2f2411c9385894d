#include "tests/validation/runner.hpp"

#include <chrono>
#include <vector>

#include "tests/validation/program.hpp"

namespace splashdown::validation {

Runner::Runner(std::filesystem::path command, std::filesystem::path scratch, bool reuse)
    : command_(std::move(command)), scratch_(std::move(scratch)), reuse_(reuse) {}

const Outcome& Runner::outcome(const Example& example, const RunSpec& run) {
  const auto folder = scratch_ / example.folder.filename() / run.name;
  const auto known = outcomes_.find(folder);
  if (known != outcomes_.end()) return known->second;
  if (reuse_ && std::filesystem::exists(folder / "summary.json"))
    return outcomes_.emplace(folder, Outcome{run.exit_code, 0, folder, ""}).first->second;
  return outcomes_.emplace(folder, execute(example, run)).first->second;
}

Outcome Runner::execute(const Example& example, const RunSpec& run) const {
  Outcome outcome;
  outcome.folder = scratch_ / example.folder.filename() / run.name;
  std::filesystem::remove_all(outcome.folder);
  std::filesystem::create_directories(outcome.folder.parent_path());
  const auto log = outcome.folder.parent_path() / (run.name + ".log");

  std::vector<std::string> words = {
      command_.string(), "run", (example.folder / run.scene).string(), "--out", outcome.folder.string(),
      "--threads",       "1"};
  words.insert(words.end(), run.arguments.begin(), run.arguments.end());
  const auto start = std::chrono::steady_clock::now();
  outcome.exit_code = run_program(words, log);
  outcome.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.log_tail = tail_of(log);
  return outcome;
}

}  // namespace splashdown::validation
