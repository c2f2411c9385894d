// Hands the runs of a study to GNU Parallel, on this machine or by ssh on others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/study/table.hpp"

namespace splashdown::apps {

/// A line a run that is not finished, for `parallel`.
std::string parallel_commands(const Study& study, const std::vector<StudyRun>& runs,
                              const std::vector<Outcome>& outcomes, const std::filesystem::path& folder);

/// Writes study.parallel and makes its runs, `jobs` at a time on each machine, until all have ended or a signal came. What runs and
/// parallel say goes to parallel.log. Throws std::runtime_error if there is no parallel.
void run_in_parallel(const std::string& commands, const std::filesystem::path& folder, int jobs);

}  // namespace splashdown::apps
