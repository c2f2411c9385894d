// Sizes of a mesh that is better for goals.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/simplices/piece_finder.hpp"

namespace splashdown {

/// Longest edges by place [m]: half of what they are in those cells that hold most of the error, as few as have `share` of it
/// (Doerfler 1996); all others stay. `by_cell`: shares of the error. Infinite outside of the mesh. Throws std::invalid_argument
/// where there are not as many as cells.
std::function<double(const Vec<2>&)> refined_size(const Eigen::Matrix2Xd& nodes,
                                                  std::span<const std::array<int, cell_nodes<2>>> cells,
                                                  std::span<const double> by_cell, double share);

/// Where several goals have their errors: shares of each, in the sum of each.
class JointShares {
 public:
  /// Of no goal yet.
  explicit JointShares(std::size_t cells) : all_(cells, 0) {}
  /// Adds a goal.
  void add(std::span<const double> by_cell);
  /// Of all.
  const std::vector<double>& all() const { return all_; }

 private:
  std::vector<double> all_;
};

/// The part of the error that is refined at a time.
inline constexpr double refined_share = 0.6;

}  // namespace splashdown
