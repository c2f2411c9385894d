#include "fluid/pfem/linear/amg_levels.hpp"

#define OMPI_SKIP_MPICXX  // deprecated C++ bindings
#include <HYPRE.h>
#include <HYPRE_parcsr_ls.h>
#include <_hypre_parcsr_ls.h>
#include <_hypre_parcsr_mv.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>

#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

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

// The whole matrix as hypre asks for it on one process: the diagonal comes first in its row.
class ParCsrMatrix {
 public:
  explicit ParCsrMatrix(const Rows<double>& rows) {
    HYPRE_BigInt range[] = {0, rows.size()};
    matrix_ = hypre_ParCSRMatrixCreate(MPI_COMM_SELF, rows.size(), rows.size(), range, range, 0, rows.start.back(), 0);
    hypre_ParCSRMatrixInitialize(matrix_);
    hypre_CSRMatrix* const local = hypre_ParCSRMatrixDiag(matrix_);
    int* const column = hypre_CSRMatrixJ(local);
    double* const value = hypre_CSRMatrixData(local);
    std::copy(rows.start.begin(), rows.start.end(), hypre_CSRMatrixI(local));
    in_parallel(static_cast<std::size_t>(rows.size()), [&](std::size_t row) {
      const int i = static_cast<int>(row);
      int to = rows.start[i] + 1;
      for (int k = rows.start[i]; k < rows.start[i + 1]; ++k) {
        const int at = rows.column[k] == i ? rows.start[i] : to++;
        column[at] = rows.column[k];
        value[at] = rows.value[k];
      }
    });
    hypre_ParCSRMatrixSetNumNonzeros(matrix_);
    hypre_ParCSRMatrixSetDNumNonzeros(matrix_);
  }
  ~ParCsrMatrix() { hypre_ParCSRMatrixDestroy(matrix_); }
  ParCsrMatrix(const ParCsrMatrix&) = delete;
  ParCsrMatrix& operator=(const ParCsrMatrix&) = delete;
  hypre_ParCSRMatrix* get() const { return matrix_; }

 private:
  hypre_ParCSRMatrix* matrix_;
};

Rows<float> rows_of(hypre_ParCSRMatrix* matrix) {
  hypre_CSRMatrix* const local = hypre_ParCSRMatrixDiag(matrix);
  const int n = hypre_CSRMatrixNumRows(local);
  Rows<float> out;
  out.start.assign(hypre_CSRMatrixI(local), hypre_CSRMatrixI(local) + n + 1);
  out.column.assign(hypre_CSRMatrixJ(local), hypre_CSRMatrixJ(local) + out.start.back());
  out.value.assign(hypre_CSRMatrixData(local), hypre_CSRMatrixData(local) + out.start.back());
  return out;
}

}  // namespace

Rows<double> whole(const SymmetricMatrix& m) {
  Rows<double> out;
  const auto size = static_cast<std::size_t>(m.size());
  sort_entries(size, size, out, [&](std::size_t j, auto put) {
    const int column = static_cast<int>(j);
    for (int k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
      put(column, m.row[k], m.value[k]);
      if (m.row[k] != column) put(m.row[k], column, m.value[k]);
    }
  });
  return out;
}

AmgLevels amg_levels(const Rows<double>& finest) {
  Mpi::need();
  ParCsrMatrix matrix(finest);
  HYPRE_Solver amg = nullptr;
  HYPRE_BoomerAMGCreate(&amg);
  HYPRE_BoomerAMGSetCoarsenType(amg, 8);   // PMIS
  HYPRE_BoomerAMGSetAggNumLevels(amg, 1);  // aggressive on the finest level
  HYPRE_BoomerAMGSetInterpType(amg, 6);    // extended+i
  HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
  HYPRE_BoomerAMGSetStrongThreshold(amg, 0.25);
  HYPRE_BoomerAMGSetMaxCoarseSize(amg, 50);
  HYPRE_BoomerAMGSetRelaxType(amg, 0);  // Jacobi: nothing to prepare, the cycles are run elsewhere
  HYPRE_BoomerAMGSetup(amg, matrix.get(), nullptr, nullptr);

  auto* const data = reinterpret_cast<hypre_ParAMGData*>(amg);
  AmgLevels out;
  for (int level = 0; level < hypre_ParAMGDataNumLevels(data); ++level) {
    out.matrix.push_back(rows_of(hypre_ParAMGDataAArray(data)[level]));
    if (level + 1 < hypre_ParAMGDataNumLevels(data))
      out.interpolation.push_back(rows_of(hypre_ParAMGDataPArray(data)[level]));
  }
  HYPRE_BoomerAMGDestroy(amg);
  HYPRE_ClearAllErrors();
  return out;
}

}  // namespace splashdown::fluid
