// Conjugate gradients on symmetric positive definite systems, preconditioned by one V-cycle of algebraic multigrid:
// hypre's BoomerAMG (Henson, Yang 2002) with one level of aggressive coarsening, extended+i interpolation and l1
// Gauss-Seidel smoothing, forward on the way down and backward on the way up. Setup and iterations cost O(rows): docs/theory.md has figures.
#pragma once

#include <memory>
#include <span>

#include "fluid/sparse.hpp"

namespace splashdown::fluid {

class Multigrid {
 public:
  explicit Multigrid(const SymmetricMatrix& matrix);
  ~Multigrid();
  /// Solves in place to a residual of `tolerance` |rhs|; false if it does not converge.
  bool solve(std::span<double> rhs, double tolerance);

 private:
  struct Hypre;
  std::unique_ptr<Hypre> h_;
};

}  // namespace splashdown::fluid
