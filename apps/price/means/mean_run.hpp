// run --accuracy and run --seconds where meshes of equal size differ: the mean of several runs in place of one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/price/price.hpp"
#include "apps/run/command.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// Where the runs beside a run stand, in its folder.
inline constexpr const char* replicates_folder = "replicates";

struct MeanOrder {
  RunOptions options;
  std::filesystem::path folder;   ///< of the run that was made
  Price price;                    ///< what was known before it
  double accuracy = 0;            ///< relative, that the mean is to have
  std::optional<double> seconds;  ///< wall seconds for all further runs
};

/// The mean of what is there that has the narrowest band over all that counts.
struct MeanFound {
  double refine = 0;
  int runs = 0;
  double seconds = 0;               ///< of the further runs
  Decided band;                     ///< relative
  std::vector<LimitAnswer> limits;  ///< of the scene, by the means where there are some
};

/// Makes further runs in the folder's `replicates` until a mean has the accuracy, and writes `mean_of_runs` into its summary.json.
/// Nothing: none has enough runs, or it was interrupted; the same call goes on.
std::optional<MeanFound> make_mean(const MeanOrder& order);

/// The plan of a mean whose missing runs take no longer than these seconds and whose band is the narrowest; nothing: there is none.
std::optional<MeanPlan> mean_in(const Price& price, double seconds);

}  // namespace splashdown::apps
