// Sums element matrices into the lower triangle of a sparse symmetric matrix of the nodes, pattern and values
// in one pass over the cells around each node: no triplets, no search in finished columns, no global sort.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace splashdown::fluid {

/// `Value`: a number, or a small matrix for several unknowns a node.
template <int d, class Value>
class Assembly {
 public:
  std::vector<int> column_start, row;  ///< as in SymmetricMatrix
  std::vector<Value> value;

  /// `unknown`: index of a node, ascending with the nodes, -1: none. `element(c, a, b)`: entry of cell c's
  /// matrix in the row of corner a and the column of corner b.
  template <class Element>
  void build(const std::vector<std::array<int, d + 1>>& cells, std::span<const int> unknown, int size,
             Element element) {
    find_corners(cells, unknown, size);
    column_start.assign(1, 0);
    column_start.reserve(size + 1);
    row.clear();
    value.clear();
    for (int j = 0; j < size; ++j) {
      column_.clear();
      column_.push_back({j, zero()});
      for (int k = corner_start_[j]; k < corner_start_[j + 1]; ++k) {
        const auto [c, b] = corners_[k];
        for (int a = 0; a <= d; ++a) {
          const int i = unknown[cells[c][a]];
          if (i < j) continue;
          add(i, element(c, a, b));
        }
      }
      append_column();
    }
  }

 private:
  struct Corner {
    int cell, corner;
  };
  struct Entry {
    int row;
    Value value;
  };

  static Value zero() {
    if constexpr (std::is_arithmetic_v<Value>)
      return 0;
    else
      return Value::Zero();
  }

  void find_corners(const std::vector<std::array<int, d + 1>>& cells, std::span<const int> unknown, int size) {
    corner_start_.assign(size + 1, 0);
    for (const auto& cell : cells)
      for (int n : cell)
        if (unknown[n] >= 0) ++corner_start_[unknown[n] + 1];
    for (int i = 0; i < size; ++i) corner_start_[i + 1] += corner_start_[i];
    corners_.resize(corner_start_.back());
    next_.assign(corner_start_.begin(), corner_start_.end());
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int k = 0; k <= d; ++k)
        if (const int i = unknown[cells[c][k]]; i >= 0) corners_[next_[i]++] = {static_cast<int>(c), k};
  }

  // A column holds half a node's neighbours: few enough to look through.
  void add(int i, const Value& v) {
    for (Entry& e : column_)
      if (e.row == i) {
        e.value += v;
        return;
      }
    column_.push_back({i, v});
  }

  void append_column() {
    for (std::size_t k = 2; k < column_.size(); ++k) {  // insertion sort; the diagonal is first already
      const Entry e = column_[k];
      std::size_t to = k;
      for (; column_[to - 1].row > e.row; --to) column_[to] = column_[to - 1];
      column_[to] = e;
    }
    for (const Entry& e : column_) {
      row.push_back(e.row);
      value.push_back(e.value);
    }
    column_start.push_back(static_cast<int>(row.size()));
  }

  std::vector<int> corner_start_, next_;
  std::vector<Corner> corners_;
  std::vector<Entry> column_;
};

}  // namespace splashdown::fluid
