// `splashdown study`: every combination of values of a scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace splashdown::apps {

struct StudyOptions {
  std::filesystem::path study;
  std::optional<std::filesystem::path> out;
  int jobs = 1;              ///< runs at a time
  std::string on = "local";  ///< "local", "parallel" or "slurm"
  bool large = false;        ///< whatever memory the runs take
  bool collect = false;      ///< tables and chart of what is there, no runs
  bool quiet = false;
};

/// Returns the exit code of the program (process/exit.hpp).
int study_command(const StudyOptions& options);

}  // namespace splashdown::apps
