// `splashdown price`, what accuracy costs, and the runs that choose their mesh by it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/command.hpp"

namespace splashdown::apps {

/// Three meshes have a band and four an order; the eighth is 5.7 times finer than the scene.
inline constexpr int fewest_rungs = 3, usual_rungs = 4, most_rungs = 8;

struct PriceOptions {
  std::filesystem::path scene;
  std::vector<std::string> set;
  std::optional<std::filesystem::path> out;
  std::vector<std::string> quantities;  ///< NAME=EXPRESSION [from TABLE] [where CONDITION]
  int rungs = usual_rungs;
  std::optional<double> budget;    ///< wall seconds for all runs
  std::optional<double> accuracy;  ///< that a mesh of the list is to have, in per cent
  bool open_water = false;         ///< what its tank does to the scene belongs to the band
  std::optional<int> threads;
  bool large = false;  ///< whatever memory the runs take
  bool quiet = false;
};

/// Returns the exit code of the program (process/exit.hpp).
int price_command(const PriceOptions& options);
/// `splashdown run` with `accuracy` or `seconds`: chooses the mesh, runs it, says what came of it. Returns the exit code.
int aimed_run_command(const RunOptions& options);

/// Where the price of a scene stands unless --out says otherwise.
std::filesystem::path price_directory(const std::filesystem::path& scene);

}  // namespace splashdown::apps
