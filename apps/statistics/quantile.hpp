// Quantiles of samples.
#pragma once

#include <algorithm>
#include <vector>

namespace splashdown::apps {

/// Of values in ascending order, one or more: what a share from 0 to 1 of them is below. Linear between order statistics:
/// Hyndman and Fan's seventh definition (1996).
inline double quantile_of(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), sorted.size() - 1);
  const auto next = std::min(i + 1, sorted.size() - 1);
  return sorted[i] + (at - static_cast<double>(i)) * (sorted[next] - sorted[i]);
}

}  // namespace splashdown::apps
