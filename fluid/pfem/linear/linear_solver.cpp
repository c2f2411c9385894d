#include "fluid/pfem/linear/linear_solver.hpp"

#include <omp.h>
#include <suitesparse/cholmod.h>

#include <algorithm>

// In OpenBLAS' cblas.h, whose package is 50 MB, and in no other.
extern "C" void openblas_set_num_threads(int);
extern "C" int openblas_get_num_threads();

namespace splashdown::fluid {
namespace {

// CHOLMOD opens parallel regions of four threads for loops of a few rows, whatever number of threads was asked
// for: they wait longer than they work, and on one core they double the time of a solve. OpenBLAS' threads each sum a
// part of a product: the last bits of its results depend on their number, and after some twenty steps in 3D all of
// them do.
class OneThread {
 public:
  OneThread() : levels_(omp_get_max_active_levels()), blas_(openblas_get_num_threads()) {
    omp_set_max_active_levels(0);
    openblas_set_num_threads(1);
  }
  ~OneThread() {
    omp_set_max_active_levels(levels_);
    openblas_set_num_threads(blas_);
  }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_, blas_;
};

}  // namespace

struct LinearSolver::Cholmod {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense* x = nullptr;  // workspaces kept between solves
  cholmod_dense* y = nullptr;
  cholmod_dense* e = nullptr;

  Cholmod() {
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
    common.print = 0;
    common.final_ll = 1;  // LDL' would accept indefinite matrices
  }
  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
};

LinearSolver::LinearSolver(int largest_direct) : largest_direct_(largest_direct), c_(std::make_unique<Cholmod>()) {}
LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

bool LinearSolver::factor(const SymmetricMatrix& matrix) {
  multigrid_.reset();
  if (matrix.size() > largest_direct_) {
    multigrid_ = std::make_unique<Multigrid>(matrix);
    return true;
  }
  auto& m = const_cast<SymmetricMatrix&>(matrix);  // CHOLMOD's C structs have no const; it does not write
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(m.size());
  a.nzmax = m.row.size();
  a.p = m.column_start.data();
  a.i = m.row.data();
  a.x = m.value.data();
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  const OneThread here;
  cholmod_free_factor(&c_->factor, &c_->common);
  c_->common.status = CHOLMOD_OK;
  c_->factor = cholmod_analyze(&a, &c_->common);
  if (c_->factor == nullptr) return false;
  cholmod_factorize(&a, c_->factor, &c_->common);
  return c_->common.status == CHOLMOD_OK && c_->factor->minor == c_->factor->n;
}

bool LinearSolver::solve(std::span<double> rhs, int columns, double tolerance, std::span<const double> guess) {
  if (multigrid_) return multigrid_->solve(rhs, columns, tolerance, guess);
  if (c_->factor == nullptr) return false;
  const OneThread here;
  cholmod_dense b{};
  b.nrow = b.d = c_->factor->n;
  b.ncol = static_cast<std::size_t>(columns);
  b.nzmax = rhs.size();
  b.x = rhs.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, c_->factor, &b, nullptr, &c_->x, nullptr, &c_->y, &c_->e, &c_->common)) return false;
  const double* solution = static_cast<const double*>(c_->x->x);
  std::copy(solution, solution + rhs.size(), rhs.begin());
  return true;
}

}  // namespace splashdown::fluid
