// Sparse symmetric positive definite systems. Up to a size CHOLMOD with AMD ordering (METIS costs more than it saves here):
// analyse + factor + solve take about 1.4 us a row at 10 k rows in 2D, 2.3 us at 90 k. Above it multigrid: factors of
// three-dimensional meshes fill.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "fluid/pfem/linear/multigrid.hpp"

namespace splashdown::fluid {

/// In 3D the factor of 10 k unknowns costs as much as multigrid's setup and all solves of a step (docs/design-notes).
template <int d>
inline constexpr int most_direct = d == 2 ? std::numeric_limits<int>::max() : 8000;

/// A x = b with A symmetric positive definite; one factor at a time, used for any number of right-hand sides.
class LinearSolver {
 public:
  /// Larger systems are solved by multigrid.
  explicit LinearSolver(int largest_direct = std::numeric_limits<int>::max());
  ~LinearSolver();
  /// Takes the factor along.
  LinearSolver(LinearSolver&&) noexcept;
  /// Takes the factor along.
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// The present factor solves to roundoff.
  bool is_direct() const { return multigrid_ == nullptr; }
  /// False if the matrix is not positive definite or memory ran out.
  bool factor(const SymmetricMatrix& matrix);
  /// Solves in place for `columns` right-hand sides stored one after the other: to roundoff if direct, else to a residual
  /// of `tolerance` times the right-hand side, from `guess` (empty: zero) on.
  bool solve(std::span<double> rhs, int columns = 1, double tolerance = 1e-8, std::span<const double> guess = {});

 private:
  struct Cholmod;
  int largest_direct_;
  std::unique_ptr<Cholmod> c_;
  std::unique_ptr<Multigrid> multigrid_;  // in use: not null
};

}  // namespace splashdown::fluid
