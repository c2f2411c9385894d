#include "fluid/amg_levels.hpp"

#define OMPI_SKIP_MPICXX  // deprecated C++ bindings
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <_hypre_parcsr_ls.h>
#include <mpi.h>

#include <cstdlib>
#include <numeric>

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
  const int n = m.size();
  Rows<double> out;
  out.start.assign(n + 1, 0);
  for (int j = 0; j < n; ++j)
    for (int k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
      ++out.start[j + 1];
      if (m.row[k] != j) ++out.start[m.row[k] + 1];
    }
  for (int i = 0; i < n; ++i) out.start[i + 1] += out.start[i];
  std::vector<int> next(out.start.begin(), out.start.end() - 1);
  out.column.resize(out.start.back());
  out.value.resize(out.start.back());
  auto put = [&](int i, int j, double v) { out.column[next[i]] = j, out.value[next[i]++] = v; };
  for (int j = 0; j < n; ++j)
    for (int k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
      put(j, m.row[k], m.value[k]);
      if (m.row[k] != j) put(m.row[k], j, m.value[k]);
    }
  return out;
}

AmgLevels amg_levels(const Rows<double>& finest) {
  Mpi::need();
  const int n = finest.size();
  std::vector<int> index(n), count(n);
  std::iota(index.begin(), index.end(), 0);
  for (int i = 0; i < n; ++i) count[i] = finest.start[i + 1] - finest.start[i];
  HYPRE_IJMatrix ij = nullptr;
  HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, n - 1, 0, n - 1, &ij);
  HYPRE_IJMatrixSetObjectType(ij, HYPRE_PARCSR);
  HYPRE_IJMatrixSetRowSizes(ij, count.data());
  HYPRE_IJMatrixInitialize(ij);
  HYPRE_IJMatrixSetValues(ij, n, count.data(), index.data(), finest.column.data(), finest.value.data());
  HYPRE_IJMatrixAssemble(ij);
  void* object = nullptr;
  HYPRE_IJMatrixGetObject(ij, &object);

  HYPRE_Solver amg = nullptr;
  HYPRE_BoomerAMGCreate(&amg);
  HYPRE_BoomerAMGSetCoarsenType(amg, 8);   // PMIS
  HYPRE_BoomerAMGSetAggNumLevels(amg, 1);  // aggressive on the finest level
  HYPRE_BoomerAMGSetInterpType(amg, 6);    // extended+i
  HYPRE_BoomerAMGSetPMaxElmts(amg, 4);
  HYPRE_BoomerAMGSetStrongThreshold(amg, 0.25);
  HYPRE_BoomerAMGSetMaxCoarseSize(amg, 50);
  HYPRE_BoomerAMGSetRelaxType(amg, 0);  // Jacobi: nothing to prepare, the cycles are run elsewhere
  HYPRE_BoomerAMGSetup(amg, static_cast<HYPRE_ParCSRMatrix>(object), nullptr, nullptr);

  auto* const data = reinterpret_cast<hypre_ParAMGData*>(amg);
  AmgLevels out;
  for (int level = 0; level < hypre_ParAMGDataNumLevels(data); ++level) {
    out.matrix.push_back(rows_of(hypre_ParAMGDataAArray(data)[level]));
    if (level + 1 < hypre_ParAMGDataNumLevels(data))
      out.interpolation.push_back(rows_of(hypre_ParAMGDataPArray(data)[level]));
  }
  HYPRE_BoomerAMGDestroy(amg);
  HYPRE_IJMatrixDestroy(ij);
  HYPRE_ClearAllErrors();
  return out;
}

}  // namespace splashdown::fluid
