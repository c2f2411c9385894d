// Levels of algebraic multigrid.
#pragma once

#include <vector>

#include "fluid/pfem/linear/counting_sort.hpp"
#include "fluid/pfem/linear/sparse.hpp"

namespace splashdown::fluid {

/// A sparse matrix by rows.
template <class Real>
struct Rows {
  std::vector<int> start, column;
  std::vector<Real> value;
  /// Number of rows.
  int size() const { return static_cast<int>(start.size()) - 1; }
};

/// Rows from entries in any order: `each(source, put)` calls put(row, column, value).
template <class Real, class Each>
void sort_entries(std::size_t sources, std::size_t size, Rows<Real>& out, Each each) {
  struct Entry {
    int column;
    Real value;
  };
  counting_sort(
      sources, size, out.start,
      [&](std::size_t source, auto put) {
        each(source, [&](int row, int column, Real value) { put(row, Entry{column, value}); });
      },
      [&](std::size_t count) { out.column.resize(count), out.value.resize(count); },
      [&](int to, const Entry& e) { out.column[to] = e.column, out.value[to] = e.value; });
}

/// The whole matrix from its lower triangle; columns ascend.
Rows<double> whole(const SymmetricMatrix& matrix);

/// Matrices and interpolations, in single precision.
struct AmgLevels {
  std::vector<Rows<float>> matrix;         ///< of each level, the finest first
  std::vector<Rows<float>> interpolation;  ///< to each level from the next coarser one
};

/// By hypre's BoomerAMG.
AmgLevels amg_levels(const Rows<double>& finest);

}  // namespace splashdown::fluid
