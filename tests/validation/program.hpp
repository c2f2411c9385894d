// Starts a program without a shell and waits for it.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace splashdown::validation {

/// Both outputs go to `log`. After `most_seconds` the program is killed. Returns its exit code, -1 if it ended by a
/// signal or could not be started.
int run_program(const std::vector<std::string>& words, const std::filesystem::path& log,
                double most_seconds = std::numeric_limits<double>::infinity());

/// The last lines of a file: enough for a closing summary or an error with its cure.
std::string tail_of(const std::filesystem::path& log);

}  // namespace splashdown::validation
