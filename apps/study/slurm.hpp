// A study as job arrays of Slurm: one task a run, one array unless it would be longer than the cluster takes, and a job
// that gathers the results when all have ended.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/study/table.hpp"

namespace splashdown::apps {

struct ArrayLimits {
  int at_a_time;
  std::size_t longest;  ///< tasks of an array
};

/// Batch scripts for the runs that are not finished: one, or as many as the longest array asks for.
std::vector<std::string> slurm_scripts(const Study& study, const std::vector<StudyRun>& runs,
                                       const std::vector<Outcome>& outcomes, const std::filesystem::path& folder,
                                       const ArrayLimits& limits);

/// MaxArraySize of this cluster; what Slurm comes with if it does not say. `folder`: for the answer.
std::size_t longest_array(const std::filesystem::path& folder);

/// Writes FOLDER/study.sbatch (study-1.sbatch, ... if there are several) and hands it to sbatch with the gathering job
/// behind it. Returns what was submitted; throws std::runtime_error with sbatch's message if it refuses.
std::string submit(const Study& study, const std::vector<std::string>& scripts, const std::filesystem::path& folder);

}  // namespace splashdown::apps
