// The cells around each node: what sums over elements into nodes becomes a sum at each node, on all threads, in the order of
// the cells, so that results are those of one loop over the cells.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/pfem/linear/counting_sort.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

/// Of each node the cells that it is a corner of.
template <int d>
class NodeCells {
 public:
  /// A corner of a cell.
  struct Corner {
    int cell;    ///< index
    int corner;  ///< 0 to d
  };

  /// O(cells + nodes), on all threads.
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
  /// Of each node the sum over its cells of what they give to each corner; the same as one loop over the cells, on all threads.
  void sum(std::span<const double> of_cells, std::vector<double>& sums) const {
    sums.assign(start_.size() - 1, 0.0);
    in_parallel(sums.size(), [&](std::size_t i) {
      for (const auto [cell, corner] : around(i)) sums[i] += of_cells[cell];
    });
  }

 private:
  std::vector<int> start_;
  std::vector<Corner> corners_;
};

}  // namespace splashdown::fluid
