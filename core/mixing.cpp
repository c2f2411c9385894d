#include "core/mixing.hpp"

#include <Eigen/QR>

namespace splashdown {

Eigen::VectorXd Mixing::way(const Eigen::VectorXd& c) {
  constexpr std::size_t most = 6;  // that are remembered
  if (last_change_.size() > 0) {
    ways_.push_back(last_way_);
    changes_.push_back(c - last_change_);
    if (ways_.size() > most) {
      ways_.erase(ways_.begin());
      changes_.erase(changes_.begin());
    }
  }
  last_change_ = last_way_ = c;
  if (changes_.empty()) return c;
  const auto count = static_cast<Eigen::Index>(changes_.size());
  Eigen::MatrixXd differences(counted_, count);
  for (Eigen::Index k = 0; k < count; ++k) differences.col(k) = changes_[static_cast<std::size_t>(k)].head(counted_);
  const Eigen::VectorXd shares = differences.colPivHouseholderQr().solve(c.head(counted_));
  if (!shares.allFinite()) return c;
  for (std::size_t k = 0; k < changes_.size(); ++k)
    last_way_ -= shares[static_cast<Eigen::Index>(k)] * (ways_[k] + changes_[k]);
  return last_way_;
}

void Mixing::forget() {
  last_way_.resize(0);
  last_change_.resize(0);
  ways_.clear();
  changes_.clear();
}

}  // namespace splashdown
