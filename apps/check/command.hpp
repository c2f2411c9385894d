// `splashdown check`: what a scene would run, and what is asked about it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

/// Returns the exit code of the program (process/exit.hpp).
int check_command(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

}  // namespace splashdown::apps
