// The cells around each node: what sums over elements into nodes becomes a sum at each node, on all threads, in the order of
// the cells, so that results are those of one loop over the cells.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/linear/counting_sort.hpp"

namespace splashdown::fluid {

template <int d>
class NodeCells {
 public:
  struct Corner {
    int cell, corner;
  };

  void build(const std::vector<std::array<int, d + 1>>& cells, std::size_t nodes) {
    counting_sort(
        cells.size(), nodes, start_,
        [&](std::size_t c, auto put) {
          for (int k = 0; k <= d; ++k) put(cells[c][k], Corner{static_cast<int>(c), k});
        },
        [&](std::size_t count) { corners_.resize(count); },
        [&](int to, const Corner& corner) { corners_[to] = corner; });
  }
  /// In ascending order of the cells.
  std::span<const Corner> around(std::size_t node) const {
    return {corners_.data() + start_[node], static_cast<std::size_t>(start_[node + 1] - start_[node])};
  }

 private:
  std::vector<int> start_;
  std::vector<Corner> corners_;
};

}  // namespace splashdown::fluid
