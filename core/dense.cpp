#include "core/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace splashdown::algebra {

Eigen::MatrixXd congruence(const Eigen::MatrixXd& M, const Eigen::MatrixXd& W) { return between(W, M, W); }

Eigen::MatrixXd between(const Eigen::MatrixXd& A, const Eigen::MatrixXd& M, const Eigen::MatrixXd& B) {
  return A.transpose() * M * B;
}

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.transpose() * B; }

Eigen::MatrixXd lifted(const Eigen::MatrixXd& L, const Eigen::MatrixXd& M) { return L * M * L.transpose(); }

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A) { return A.completeOrthogonalDecomposition().pseudoInverse(); }

Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.ldlt().solve(B); }

namespace {

class LowerTriangle final : public Cholesky {
 public:
  explicit LowerTriangle(const Eigen::MatrixXd& A) : factor_(A) {}
  bool is_better_than(double condition) const {
    return factor_.info() == Eigen::Success && factor_.rcond() * condition > 1;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const override { return factor_.solve(b); }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace

std::unique_ptr<Cholesky> Cholesky::of(const Eigen::MatrixXd& A, double condition) {
  auto made = std::make_unique<LowerTriangle>(A);
  if (!made->is_better_than(condition)) return nullptr;
  return made;
}

Solutions solutions_of(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double negligible) {
  const Eigen::Index n = A.cols();
  if (A.rows() == 0 || n == 0)
    return {Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Identity(n, n), Eigen::MatrixXd::Identity(A.rows(), A.rows())};
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(negligible);
  return {svd.solve(b), svd.matrixV().rightCols(n - svd.rank()), svd.matrixU().rightCols(A.rows() - svd.rank())};
}

Principal principal_of(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace splashdown::algebra
