// A study as a job array of Slurm: one task a run, and a job that gathers the results when all have ended.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/study_table.hpp"

namespace splashdown::apps {

/// The batch script for the runs that are not finished, `jobs` of them at a time.
std::string slurm_script(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes,
                         const std::filesystem::path& folder, int jobs);

/// Writes FOLDER/study.sbatch and hands it to sbatch with the gathering job behind it. Returns what sbatch
/// said; throws std::runtime_error with its message if it refuses.
std::string submit(const Study& study, const std::string& script, const std::filesystem::path& folder);

}  // namespace splashdown::apps
