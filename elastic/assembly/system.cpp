#include "elastic/assembly/system.hpp"

namespace splashdown::elastic {

void leave_out(const std::vector<bool>& held, double diagonal, Sparse& matrix) {
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      if (held[static_cast<std::size_t>(entry.row())] || held[static_cast<std::size_t>(column)])
        entry.valueRef() = entry.row() == column ? diagonal : 0;
}

void leave_out(const std::vector<bool>& held, Field& field) {
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k]) field[static_cast<Eigen::Index>(k)] = 0;
}

}  // namespace splashdown::elastic
