// `splashdown ablate`: what each effect and each choice does to the numbers of a scene and to its clock.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/outlook/advice.hpp"

namespace splashdown::apps {

struct AblateOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;
  std::optional<std::filesystem::path> out;
  std::vector<std::string> quantities;  ///< as of price
  std::vector<std::string> only;        ///< effects and choices; empty: all
  bool all = false;                     ///< adds effects whatever is advised
  double matters = 100 * least_change;  ///< per cent
  int jobs = 1;                         ///< runs at a time
  std::optional<int> threads;           ///< of each run
  bool large = false;                   ///< whatever memory the runs take
  bool collect = false;                 ///< tables and chart of what is there, no runs
  bool quiet = false;
};

/// Returns the exit code of the program (process/exit.hpp).
int ablate_command(const AblateOptions& options);

}  // namespace splashdown::apps
