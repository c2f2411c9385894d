#include "fluid/ale/linear/direct_solver.hpp"

#include <suitesparse/umfpack.h>

#include <stdexcept>

// Without its development package there is no header.
extern "C" void openblas_set_num_threads(int);
extern "C" int openblas_get_num_threads();

namespace splashdown::ale {
namespace {

/// Small products of dense blocks gain nothing from threads, and sums would depend on how many there are.
class OneThread {
 public:
  OneThread() : threads_(openblas_get_num_threads()) { openblas_set_num_threads(1); }
  ~OneThread() { openblas_set_num_threads(threads_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int threads_;
};

}  // namespace

struct DirectSolver::Factors {
  double control[UMFPACK_CONTROL];
  double info[UMFPACK_INFO];
  void* symbolic = nullptr;
  void* numeric = nullptr;
  Eigen::SparseMatrix<double> matrix;

  Factors() {
    umfpack_di_defaults(control);
    // Patterns are symmetric, and zeros on the diagonal are no reason to forget it: three times less fill than by columns.
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control[UMFPACK_IRSTEP] = 0;
  }
  ~Factors() {
    drop();
    umfpack_di_free_symbolic(&symbolic);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  void drop() { umfpack_di_free_numeric(&numeric); }
};

DirectSolver::DirectSolver() : factors_(std::make_unique<Factors>()) {}
DirectSolver::~DirectSolver() = default;
DirectSolver::DirectSolver(DirectSolver&&) noexcept = default;
DirectSolver& DirectSolver::operator=(DirectSolver&&) noexcept = default;

bool DirectSolver::is_ready() const { return factors_->numeric != nullptr; }
double DirectSolver::fill() const { return is_ready() ? factors_->info[UMFPACK_LNZ] + factors_->info[UMFPACK_UNZ] : 0; }

bool DirectSolver::factor(const Eigen::SparseMatrix<double>& matrix) {
  const OneThread alone;
  auto& f = *factors_;
  f.drop();
  f.matrix = matrix;
  const auto n = static_cast<int>(matrix.rows());
  const int *starts = f.matrix.outerIndexPtr(), *rows = f.matrix.innerIndexPtr();
  const double* values = f.matrix.valuePtr();
  if (!f.symbolic && umfpack_di_symbolic(n, n, starts, rows, values, &f.symbolic, f.control, f.info) != UMFPACK_OK)
    return false;
  if (umfpack_di_numeric(starts, rows, values, f.symbolic, &f.numeric, f.control, f.info) == UMFPACK_OK) return true;
  f.drop();
  return false;
}

Eigen::VectorXd DirectSolver::solve(const Eigen::VectorXd& right) const {
  const OneThread alone;
  const auto& f = *factors_;
  if (!f.numeric) throw std::logic_error("direct solver: there is no factor");
  Eigen::VectorXd x(right.size());
  double info[UMFPACK_INFO];
  umfpack_di_solve(UMFPACK_A, f.matrix.outerIndexPtr(), f.matrix.innerIndexPtr(), f.matrix.valuePtr(), x.data(),
                   right.data(), f.numeric, f.control, info);
  return x;
}

}  // namespace splashdown::ale
