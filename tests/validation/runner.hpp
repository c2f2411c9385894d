// Runs the splashdown command for an example, once a run, each in its own folder.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/validation/check.hpp"

namespace splashdown::validation {

struct Outcome {
  int exit_code = -1;            ///< -1: ended by a signal or not started
  double wall_seconds = 0;       ///< seen from outside
  std::filesystem::path folder;  ///< what the run left behind
  std::string log_tail;          ///< last lines it printed
};

class Runner {
 public:
  /// `reuse`: take a folder that already holds a summary.json as the run's outcome.
  Runner(std::filesystem::path command, std::filesystem::path scratch, bool reuse);
  const Outcome& outcome(const Example& example, const RunSpec& run);

 private:
  Outcome execute(const Example& example, const RunSpec& run) const;

  std::filesystem::path command_, scratch_;
  bool reuse_;
  std::map<std::filesystem::path, Outcome> outcomes_;  ///< by folder
};

}  // namespace splashdown::validation
