// A sparse symmetric matrix.
#pragma once

#include <vector>

namespace splashdown::fluid {

/// Lower triangle by columns; row indices ascend within a column, the diagonal comes first.
struct SymmetricMatrix {
  std::vector<int> column_start;  ///< of each column its first entry, and the number of entries
  std::vector<int> row;           ///< of each entry
  std::vector<double> value;      ///< of each entry
  /// Number of columns.
  int size() const { return static_cast<int>(column_start.size()) - 1; }
};

}  // namespace splashdown::fluid
