// Sparse systems without symmetry, by their factors (UMFPACK: Davis, ACM TOMS 30, 2004).
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace splashdown::ale {

/// Factors of a matrix, one pattern for good. Same bits for the same numbers.
class DirectSolver {
 public:
  DirectSolver();
  ~DirectSolver();
  /// Takes the factors over; what is left may only be destroyed or assigned to.
  DirectSolver(DirectSolver&&) noexcept;
  /// The same.
  DirectSolver& operator=(DirectSolver&&) noexcept;

  /// Factors the compressed matrix. False where it is singular or memory runs out; there is no factor then.
  bool factor(const Eigen::SparseMatrix<double>& matrix);
  /// Whether there is a factor.
  bool is_ready() const;
  /// Solves with the factor; throws std::logic_error without one.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// Numbers in the factors.
  double fill() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace splashdown::ale
