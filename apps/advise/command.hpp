// `splashdown advise`: which effects a scene calls for, by its numbers, before it is run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

struct AdviseOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;
  bool json = false;
};

/// Returns the exit code of the program (process/exit.hpp).
int advise_command(const AdviseOptions& options);

}  // namespace splashdown::apps
