// Dense algebra of matrices whose size is known at run time only: motions, conditions and impulses of bodies.
//
// Eigen's templates for such sizes take seconds to compile in every source that names them; these are compiled once.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace splashdown::algebra {

/// W^T M W
Eigen::MatrixXd congruence(const Eigen::MatrixXd& M, const Eigen::MatrixXd& W);
/// A^T M B
Eigen::MatrixXd between(const Eigen::MatrixXd& A, const Eigen::MatrixXd& M, const Eigen::MatrixXd& B);
/// A^T B
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// L M L^T
Eigen::MatrixXd lifted(const Eigen::MatrixXd& L, const Eigen::MatrixXd& M);

/// The x of least norm with least |A x - b|: complete orthogonal decomposition (Golub, Van Loan, section 5.4.7).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// A^+, the pseudo-inverse (Moore, Penrose): A^+ b is the x of least norm with least |A x - b|.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);
/// A^-1 B with A symmetric and not negative: LDL^T.
Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A = L L^T of a symmetric positive A, for many solutions with it: a sixth of the work of an inverse.
class Cholesky {
 public:
  /// Of the lower half of A; empty where A is not positive, or its condition (1-norm, Higham 1988) above `condition`.
  static std::unique_ptr<Cholesky> of(const Eigen::MatrixXd& A, double condition);
  virtual ~Cholesky() = default;
  /// x with A x = b.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) const = 0;
};

/// All x with A x = b, x = point + directions w: the point of least norm, orthonormal directions. Conditions that
/// contradict each other are met in the least-squares sense; singular values below `negligible` of the largest are zero.
struct Solutions {
  Eigen::VectorXd point;       ///< the solution of least norm
  Eigen::MatrixXd directions;  ///< a column each, orthonormal
  Eigen::MatrixXd idle;        ///< combinations of conditions that repeat each other, idle^T A = 0; orthonormal
};
/// By singular values: A = U S V^T, point = V S^+ U^T b. An empty A leaves all directions.
Solutions solutions_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double negligible);

/// Eigenvalues and eigenvectors.
struct Principal {
  Eigen::VectorXd values;      ///< from the lowest up
  Eigen::MatrixXd directions;  ///< V: a column each, orthonormal
};
/// A = V diag(values) V^T of a symmetric A, by its tridiagonal form (Golub, Van Loan, section 8.3).
Principal principal_of(const Eigen::MatrixXd& A);

}  // namespace splashdown::algebra
