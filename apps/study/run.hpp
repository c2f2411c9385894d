// Makes the runs of a study, each in a process of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/study/table.hpp"

namespace splashdown::apps {

/// The command line of one run; it begins anew or continues, whatever its folder holds.
std::vector<std::string> command_of(const Study& study, const StudyRun& run, const std::filesystem::path& folder);

/// Seconds left if a run ended every `between` seconds so far, `runs` are to end and the last one did so `since` seconds
/// ago. Between two ends it goes down and stops, it never grows.
double study_time_left(double between, std::size_t runs, double since);

struct RunnerEnd {
  bool interrupted = false;
  bool enough = false;              ///< runs are left that the study does not need: its band is narrow enough
  std::vector<std::string> unable;  ///< runs without an end of their own, each with its reason
};

/// Makes all runs whose outcome is not finished, `jobs` at a time, and renews the tables after each, or where they are long, now and then.
/// Begins no more once `study.stop` is satisfied. SIGINT and SIGTERM stop the runs with checkpoints.
RunnerEnd make_runs(const Study& study, const std::vector<StudyRun>& runs, std::vector<Outcome>& outcomes,
                    const std::filesystem::path& folder, int jobs, bool quiet);

/// Exit code of the program after these runs: a coupling that diverges or stalls is a result; anything else that stops a run is not.
int exit_code_of(const std::vector<Outcome>& outcomes, bool interrupted);

}  // namespace splashdown::apps
