#include "fluid/multigrid.hpp"

#define OMPI_SKIP_MPICXX  // deprecated C++ bindings
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace splashdown::fluid {
namespace {

constexpr int most_iterations = 200;  // ten times what meshes of the validation cases need

// hypre is built upon MPI, which this program uses for itself alone.
class Mpi {
 public:
  static void need() { static const Mpi here; }

 private:
  Mpi() {
    int running = 0;
    MPI_Initialized(&running);
    if (!running) {
      setenv("OMPI_MCA_btl", "self", 0);  // no search for networks
      MPI_Init(nullptr, nullptr);
      std::atexit([] { MPI_Finalize(); });
    }
    HYPRE_Init();
  }
};

// Rows of the whole matrix from its lower triangle.
struct Rows {
  explicit Rows(const SymmetricMatrix& m) : count(m.size(), 0) {
    const int n = m.size();
    for (int j = 0; j < n; ++j)
      for (int k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
        ++count[j];
        if (m.row[k] != j) ++count[m.row[k]];
      }
    std::vector<int> next(n, 0);
    for (int i = 1; i < n; ++i) next[i] = next[i - 1] + count[i - 1];
    column.resize(2 * m.row.size() - n);
    value.resize(column.size());
    auto put = [&](int i, int j, double v) { column[next[i]] = j, value[next[i]++] = v; };
    // Ascending: left of the diagonal comes from earlier columns.
    for (int j = 0; j < n; ++j)
      for (int k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
        put(j, m.row[k], m.value[k]);
        if (m.row[k] != j) put(m.row[k], j, m.value[k]);
      }
  }
  std::vector<int> count, column;
  std::vector<double> value;
};

class Vector {
 public:
  explicit Vector(int n) : n_(n), index_(n) {
    std::iota(index_.begin(), index_.end(), 0);
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, n - 1, &ij_);
    HYPRE_IJVectorSetObjectType(ij_, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(ij_);
    HYPRE_IJVectorAssemble(ij_);
  }
  ~Vector() { HYPRE_IJVectorDestroy(ij_); }
  Vector(const Vector&) = delete;
  Vector& operator=(const Vector&) = delete;
  void set(const double* values) { HYPRE_IJVectorSetValues(ij_, n_, index_.data(), values); }
  void get(double* values) const { HYPRE_IJVectorGetValues(ij_, n_, index_.data(), values); }
  HYPRE_ParVector par() const {
    void* object = nullptr;
    HYPRE_IJVectorGetObject(ij_, &object);
    return static_cast<HYPRE_ParVector>(object);
  }

 private:
  int n_;
  std::vector<int> index_;
  HYPRE_IJVector ij_ = nullptr;
};

}  // namespace

struct Multigrid::Hypre {
  explicit Hypre(const SymmetricMatrix& m) : b(m.size()), x(m.size()) {
    const int n = m.size();
    const Rows rows(m);
    std::vector<int> index(n), count = rows.count;
    std::iota(index.begin(), index.end(), 0);
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, n - 1, 0, n - 1, &ij);
    HYPRE_IJMatrixSetObjectType(ij, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(ij, count.data());
    HYPRE_IJMatrixInitialize(ij);
    HYPRE_IJMatrixSetValues(ij, n, count.data(), index.data(), rows.column.data(), rows.value.data());
    HYPRE_IJMatrixAssemble(ij);
    void* object = nullptr;
    HYPRE_IJMatrixGetObject(ij, &object);
    matrix = static_cast<HYPRE_ParCSRMatrix>(object);

    HYPRE_BoomerAMGCreate(&amg);
    HYPRE_BoomerAMGSetCoarsenType(amg, 8);   // PMIS
    HYPRE_BoomerAMGSetAggNumLevels(amg, 1);  // aggressive on the finest level
    HYPRE_BoomerAMGSetInterpType(amg, 6);    // extended+i
    HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
    HYPRE_BoomerAMGSetStrongThreshold(amg, 0.25);
    HYPRE_BoomerAMGSetCycleRelaxType(amg, 13, 1);  // l1 Gauss-Seidel, forward on the way down ...
    HYPRE_BoomerAMGSetCycleRelaxType(amg, 14, 2);  // ... and backward on the way up: symmetric
    HYPRE_BoomerAMGSetMaxIter(amg, 1);
    HYPRE_BoomerAMGSetTol(amg, 0);
    HYPRE_ParCSRPCGCreate(MPI_COMM_SELF, &cg);
    HYPRE_PCGSetMaxIter(cg, most_iterations);
    HYPRE_PCGSetTwoNorm(cg, 1);
    HYPRE_PCGSetPrecond(cg, reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                        reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup), amg);
    HYPRE_ParCSRPCGSetup(cg, matrix, b.par(), x.par());
    HYPRE_ClearAllErrors();
  }
  ~Hypre() {
    HYPRE_ParCSRPCGDestroy(cg);
    HYPRE_BoomerAMGDestroy(amg);
    HYPRE_IJMatrixDestroy(ij);
  }
  Hypre(const Hypre&) = delete;
  Hypre& operator=(const Hypre&) = delete;

  HYPRE_IJMatrix ij = nullptr;
  HYPRE_ParCSRMatrix matrix = nullptr;
  HYPRE_Solver amg = nullptr, cg = nullptr;
  Vector b, x;
};

Multigrid::Multigrid(const SymmetricMatrix& matrix) {
  Mpi::need();
  h_ = std::make_unique<Hypre>(matrix);
}
Multigrid::~Multigrid() = default;

bool Multigrid::solve(std::span<double> rhs, double tolerance) {
  if (std::all_of(rhs.begin(), rhs.end(), [](double r) { return r == 0; })) return true;
  h_->b.set(rhs.data());
  HYPRE_ParVectorSetConstantValues(h_->x.par(), 0);
  HYPRE_PCGSetTol(h_->cg, tolerance);
  HYPRE_ParCSRPCGSolve(h_->cg, h_->matrix, h_->b.par(), h_->x.par());
  int converged = 0;
  HYPRE_PCGGetConverged(h_->cg, &converged);
  HYPRE_ClearAllErrors();
  h_->x.get(rhs.data());
  return converged != 0;
}

}  // namespace splashdown::fluid
