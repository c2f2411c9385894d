// The cells around each node: what sums over elements into nodes becomes a sum at each node, on all threads, in the order of
// the cells, so that results are those of one loop over the cells.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace splashdown::fluid {

template <int d>
class NodeCells {
 public:
  struct Corner {
    int cell, corner;
  };

  void build(const std::vector<std::array<int, d + 1>>& cells, std::size_t nodes) {
    start_.assign(nodes + 1, 0);
    for (const auto& cell : cells)
      for (int n : cell) ++start_[n + 1];
    for (std::size_t n = 0; n < nodes; ++n) start_[n + 1] += start_[n];
    corners_.resize(start_.back());
    next_.assign(start_.begin(), start_.end() - 1);
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int k = 0; k <= d; ++k) corners_[next_[cells[c][k]]++] = {static_cast<int>(c), k};
  }
  /// In ascending order of the cells.
  std::span<const Corner> around(std::size_t node) const {
    return {corners_.data() + start_[node], static_cast<std::size_t>(start_[node + 1] - start_[node])};
  }

 private:
  std::vector<int> start_, next_;
  std::vector<Corner> corners_;
};

}  // namespace splashdown::fluid
