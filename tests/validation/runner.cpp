#include "tests/validation/runner.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <deque>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace splashdown::validation {

namespace {

/// Starts the program without a shell, both outputs to `log`, and waits. -1: no exit code.
int run_program(const std::vector<std::string>& words, const std::filesystem::path& log) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int failed = posix_spawn(&child, argv.front(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  int status = 0;
  if (waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string tail_of(const std::filesystem::path& log) {
  constexpr std::size_t lines = 12;  // enough for a closing summary or an error with its cure
  std::ifstream in(log);
  std::deque<std::string> last;
  for (std::string line; std::getline(in, line);) {
    last.push_back(line);
    if (last.size() > lines) last.pop_front();
  }
  return fmt::format("{}", fmt::join(last, "\n"));
}

}  // namespace

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
