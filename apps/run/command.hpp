// `splashdown run`: one scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

struct RunOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::optional<std::filesystem::path> out;
  std::optional<double> until;
  std::optional<double> budget;
  std::optional<int> threads;
  std::optional<double> accuracy;              ///< wanted, in per cent: chooses fluid.size.refine
  std::optional<double> seconds;               ///< wanted: the same
  std::optional<std::filesystem::path> price;  ///< folder of the price list to choose by
  bool resume = false;
  bool large = false;      ///< whatever memory it takes
  bool restart = false;    ///< begin anew, although the folder holds a run of this scene
  bool no_report = false;  ///< none is drawn at the end
  bool force = false;      ///< and although it holds one of another scene
  bool quiet = false;
};

/// Returns the exit code of the program (process/exit.hpp).
int run_command(const RunOptions& options);

}  // namespace splashdown::apps
