// Levels of algebraic multigrid.
#pragma once

#include <vector>

#include "fluid/sparse.hpp"

namespace splashdown::fluid {

/// A sparse matrix by rows.
template <class Real>
struct Rows {
  std::vector<int> start, column;
  std::vector<Real> value;
  int size() const { return static_cast<int>(start.size()) - 1; }
};

/// The whole matrix from its lower triangle; columns ascend.
Rows<double> whole(const SymmetricMatrix& matrix);

struct AmgLevels {
  std::vector<Rows<float>> matrix;         ///< of each level, the finest first
  std::vector<Rows<float>> interpolation;  ///< to each level from the next coarser one
};

/// By hypre's BoomerAMG.
AmgLevels amg_levels(const Rows<double>& finest);

}  // namespace splashdown::fluid
