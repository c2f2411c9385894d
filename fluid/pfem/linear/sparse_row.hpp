// One row of a sparse matrix while it is summed up: no search for the entry that a contribution belongs to.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace splashdown::fluid {

/// `Value`: a number, or a small matrix.
template <class Value>
class SparseRow {
 public:
  /// A sum and the column that it stands in.
  struct Entry {
    int column;   ///< index
    Value value;  ///< what was added so far
  };

  /// `columns`: of the matrix; memory O(columns).
  explicit SparseRow(std::size_t columns) : seen_(columns) {}

  /// Starts the next row.
  void clear() {
    entries_.clear();
    ++row_;
  }
  /// Adds to the entry of a column, O(1).
  void add(int column, const Value& value) {
    Seen& seen = seen_[column];
    if (seen.row == row_) {
      entries_[seen.entry].value += value;
    } else {
      seen = {row_, static_cast<int>(entries_.size())};
      entries_.push_back({column, value});
    }
  }
  /// In the order in which their columns came up first.
  std::span<Entry> entries() { return entries_; }

 private:
  struct Seen {
    int row = 0, entry = 0;  // the last row with this column, 0: none yet, and its place there
  };
  int row_ = 1;
  std::vector<Seen> seen_;
  std::vector<Entry> entries_;
};

}  // namespace splashdown::fluid
