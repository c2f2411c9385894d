// A sparse symmetric matrix.
#pragma once

#include <vector>

namespace splashdown::fluid {

/// Lower triangle by columns; row indices ascend within a column, the diagonal comes first.
struct SymmetricMatrix {
  std::vector<int> column_start;
  std::vector<int> row;
  std::vector<double> value;
  int size() const { return static_cast<int>(column_start.size()) - 1; }
};

}  // namespace splashdown::fluid
