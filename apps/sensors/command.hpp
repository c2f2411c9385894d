// `splashdown sensors`: where signals of two runs differ most.
#pragma once

#include <filesystem>
#include <string>

namespace splashdown::apps {

struct SensorsOptions {
  std::filesystem::path reference, other;  ///< folders of runs
  std::string kind = "uy";                 ///< what follows the dot in names of probes
  int count = 3;                           ///< places that are chosen
  bool all = false;                        ///< print all candidates
};

/// Returns the exit code of the program (process/exit.hpp).
int sensors_command(const SensorsOptions& options);

}  // namespace splashdown::apps
