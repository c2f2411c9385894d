// Conjugate gradients on symmetric positive definite systems, preconditioned by one V-cycle of algebraic multigrid.
//
// hypre's BoomerAMG builds the levels (Henson, Yang 2002; PMIS coarsening, aggressive at first, extended+i interpolation).
// The cycles are run here, on all threads and for several right-hand sides at once, in single precision: hypre as
// Debian builds it has neither. Smoother: l1 Gauss-Seidel within a fixed number of blocks of rows, forward on the way down,
// backward on the way up (Baker, Falgout, Kolev, Yang 2011), so that results do not depend on the number of threads.
// Setup and iterations cost O(rows): docs/design-notes has figures.
#pragma once

#include <memory>
#include <span>

#include "fluid/pfem/linear/sparse.hpp"

namespace splashdown::fluid {

/// A x = b with A symmetric positive definite, for large A.
class Multigrid {
 public:
  /// Builds the levels; the matrix need not outlive this.
  explicit Multigrid(const SymmetricMatrix& matrix);
  ~Multigrid();
  /// Solves in place for `columns` right-hand sides stored one after the other, to residuals of `tolerance` |rhs| each,
  /// starting from `guess` (as long as rhs; empty: zero); false if one does not converge.
  bool solve(std::span<double> rhs, int columns, double tolerance, std::span<const double> guess = {});

 private:
  struct Level;
  struct Hierarchy;
  std::unique_ptr<Hierarchy> h_;
};

}  // namespace splashdown::fluid
