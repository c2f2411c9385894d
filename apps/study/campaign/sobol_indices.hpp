// Which random axes the scatter of a number comes from: Sobol indices of a Saltelli plan.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "apps/study/campaign/sample.hpp"

namespace splashdown::apps {

/// Shares of the variance of Y, in estimates of Jansen (1999) as Saltelli et al. (2010) recommend.
struct SobolIndex {
  double first = 0;             ///< V(E(Y | x_i)) / V(Y): what would go if x_i alone were known
  double total = 0;             ///< E(V(Y | all but x_i)) / V(Y): what would stay if all but x_i were known
  Band first_band, total_band;  ///< 95 %, by 500 bootstrap samples of the rows
};

/// An index an axis. `values`: by point of a Saltelli plan of `axes` axes, nothing for runs without a number. A row is used if all of
/// its runs have one; `rows`: how many are. Empty: fewer than eight rows, or no variance.
std::vector<SobolIndex> sobol_indices(std::span<const std::optional<double>> values, std::size_t axes,
                                      std::size_t& rows);

}  // namespace splashdown::apps
