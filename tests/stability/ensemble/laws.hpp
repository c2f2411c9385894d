// What the laws say of a run that is over.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/stability/ensemble/member.hpp"

namespace splashdown::ensemble {

/// What is left of a member's run.
struct Run {
  int exit_code = -1;  ///< -1: killed, or ended by a signal
  double wall_seconds = 0;
  std::filesystem::path folder;
  std::string log;  ///< its last lines
};

struct Finding {
  std::string law;
  double measured = 0;  ///< nan: there is nothing to measure, the law is broken
  double bound = 0;
  std::string note;
  bool held() const { return measured <= bound; }  // nan does not hold
};

struct Verdict {
  std::vector<Finding> findings;
  bool refused = false;  ///< a scene that may be refused was: its laws have no object
  bool cut = false;      ///< stopped by its budget or killed
  std::string cause;     ///< of a run that ended early
  bool held() const;
  /// The finding that is farthest beyond, or nearest to, its bound.
  const Finding* worst() const;
};

/// Reads fluid.csv, bodies.csv, summary.json and added_mass.csv of the run.
Verdict judge(const Member& member, const Run& run);

}  // namespace splashdown::ensemble
