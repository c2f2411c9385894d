// Sums element matrices into the lower triangle of a sparse symmetric matrix of the nodes, pattern and values
// in one pass over the cells around each node: no triplets, no search in finished columns, no global sort. Blocks of
// columns are independent of each other.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "fluid/pfem/linear/sparse_row.hpp"
#include "fluid/pfem/mesh/node_cells.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

/// The lower triangle of sum over cells of element matrices. `Value`: a number, or a small matrix for several unknowns a node.
template <int d, class Value>
class Assembly {
 public:
  std::vector<int> column_start;  ///< as in SymmetricMatrix
  std::vector<int> row;           ///< as in SymmetricMatrix
  std::vector<Value> value;       ///< of the entries, beside `row`

  /// `unknown`: index of a node, ascending with the nodes, -1: none; `node`: of an unknown. `element(c, a, b)`: entry of
  /// cell c's matrix in the row of corner a and the column of corner b; called on all threads.
  template <class Element>
  void build(const std::vector<std::array<int, d + 1>>& cells, const NodeCells<d>& around, std::span<const int> unknown,
             std::span<const int> node, Element element) {
    const std::size_t size = node.size(), count = (size + columns_a_block - 1) / columns_a_block;
    column_start.resize(size + 1);
    column_start[0] = 0;
    blocks_.resize(count);
    PerThread<SparseRow<Value>> columns([&] { return SparseRow<Value>(size); });
    in_pieces(count, 1, [&](std::size_t from, std::size_t to) {
      auto& column = columns.local();
      for (std::size_t b = from; b < to; ++b) {
        Block& block = blocks_[b];
        block.row.clear();
        block.value.clear();
        for (std::size_t j = b * columns_a_block; j < std::min(size, (b + 1) * columns_a_block); ++j) {
          column.clear();
          column.add(static_cast<int>(j), zero());
          for (const auto [c, corner] : around.around(node[j]))
            for (int a = 0; a <= d; ++a) {
              const int i = unknown[cells[c][a]];
              if (i >= static_cast<int>(j)) column.add(i, element(c, a, corner));
            }
          block.append(column.entries());
          column_start[j + 1] = static_cast<int>(block.row.size());
        }
      }
    });
    join();
  }

 private:
  static constexpr std::size_t columns_a_block = 4096;
  struct Block {
    std::vector<int> row;
    std::vector<Value> value;

    void append(std::span<typename SparseRow<Value>::Entry> column) {
      for (std::size_t k = 2; k < column.size(); ++k) {  // insertion sort; the diagonal is first already
        const auto e = column[k];
        std::size_t to = k;
        for (; column[to - 1].column > e.column; --to) column[to] = column[to - 1];
        column[to] = e;
      }
      for (const auto& e : column) {
        row.push_back(e.column);
        value.push_back(e.value);
      }
    }
  };

  static Value zero() {
    if constexpr (std::is_arithmetic_v<Value>)
      return 0;
    else
      return Value::Zero();
  }

  void join() {
    std::vector<int> before(blocks_.size() + 1, 0);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      before[b + 1] = before[b] + static_cast<int>(blocks_[b].row.size());
    row.resize(before.back());
    value.resize(before.back());
    in_pieces(blocks_.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t b = from; b < to; ++b) {
        std::copy(blocks_[b].row.begin(), blocks_[b].row.end(), row.begin() + before[b]);
        std::copy(blocks_[b].value.begin(), blocks_[b].value.end(), value.begin() + before[b]);
        const std::size_t last = std::min(column_start.size() - 1, (b + 1) * columns_a_block);
        for (std::size_t j = b * columns_a_block; j < last; ++j) column_start[j + 1] += before[b];
      }
    });
  }

  std::vector<Block> blocks_;
};

}  // namespace splashdown::fluid
