// All schemes come down to equations of one form for the displacements at one instant,
//
//   m M (u - p) + c C (u - q) + w f(u) = g,
//
// solved by Newton's method with the full tangent, m M + c C + w K(u), factored as LDL^T. It ends when a correction is below
// `tolerance` of the way that u has come, or at roundoff. Convergence is quadratic: what is left is the square of that. Of a
// linear system the factor is kept until m, c or w change.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <optional>

#include "core/status.hpp"
#include "elastic/assembly/system.hpp"

namespace splashdown::elastic {

/// The equations of a stage; fields as long as the unknowns.
struct Stage {
  double mass = 0;       ///< m [1/s^2]
  double damping = 0;    ///< c [1/s]
  double force = 1;      ///< w
  Field p = {}, q = {};  ///< [m]; of terms whose factor is zero they may be empty
  Field g = {};          ///< [N, N/m]
};

/// When Newton's method ends.
struct NewtonLimits {
  double tolerance = 1e-8;  ///< of a correction, relative: after it 1e-16 of the way is left
  int most = 20;            ///< iterations: six are usual
};

/// Factors and scratch, kept from stage to stage.
class StageSolver {
 public:
  /// Without factors yet.
  explicit StageSolver(NewtonLimits limits = {}) : limits_(limits) {}
  /// From `u`, which becomes the solution; held unknowns stay. `C`: of a stage with damping, else null. Refused where Newton's
  /// method does not converge; `u` is then of no use.
  Status solve(const System& system, const Stage& stage, const Sparse* C, Field& u);
  /// x with M x = r in the free unknowns, zero in the held ones.
  Status solve_mass(const System& system, const Field& r, Field& x);
  /// Newton iterations so far.
  long iterations() const { return iterations_; }

 private:
  bool factor(const System& system, Sparse& matrix);
  /// The factor of m M + c C + w K(u), or the one that there is.
  bool factor_tangent(const System& system, const Stage& stage, const Sparse* C, const Field& u);

  NewtonLimits limits_;
  Eigen::SimplicialLDLT<Sparse> factor_;
  Eigen::Index analysed_ = 0;
  Sparse K_, A_;
  std::optional<std::array<double, 3>> factored_;  // m, c, w of the factor of a linear system
  long iterations_ = 0;
};

}  // namespace splashdown::elastic
