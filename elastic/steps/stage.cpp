#include "elastic/steps/stage.hpp"

#include <cmath>

namespace splashdown::elastic {

bool StageSolver::factor(const System& system, Sparse& matrix) {
  leave_out(system.held(), matrix.diagonal().cwiseAbs().maxCoeff(), matrix);
  if (analysed_ != matrix.nonZeros()) {
    factor_.analyzePattern(matrix);
    analysed_ = matrix.nonZeros();
  }
  factor_.factorize(matrix);
  return factor_.info() == Eigen::Success;
}

Status StageSolver::solve_mass(const System& system, const Field& r, Field& x) {
  A_ = system.mass();
  factored_.reset();
  if (!factor(system, A_)) return {"the solid's mass matrix is singular"};
  Field right = r;
  leave_out(system.held(), right);
  x = factor_.solve(right);
  return {};
}

bool StageSolver::factor_tangent(const System& system, const Stage& stage, const Sparse* C, const Field& u) {
  const std::array<double, 3> factors{stage.mass, C ? stage.damping : 0, stage.force};
  if (factored_ == factors) return true;
  factored_.reset();
  system.stiffness(u, K_);
  A_ = K_;
  A_.coeffs() *= stage.force;
  if (stage.mass != 0) A_.coeffs() += stage.mass * system.mass().coeffs();
  if (C) A_.coeffs() += stage.damping * C->coeffs();
  if (!factor(system, A_)) return false;
  if (system.linear()) factored_ = factors;
  return true;
}

Status StageSolver::solve(const System& system, const Stage& stage, const Sparse* C, Field& u) {
  const Field start = u;
  // Coordinates have no more digits than this.
  const double roundoff = 1e-14 * system.length();
  constexpr double solved = 1e-10;  // of the first residual: a hundredth of `tolerance`
  double last = std::numeric_limits<double>::infinity(), first = 0, before = 0;
  for (int k = 0; k < limits_.most; ++k, ++iterations_) {
    Field residual = stage.force * system.internal_force(u) - stage.g;
    if (stage.mass != 0) residual += stage.mass * (system.mass() * (u - stage.p));
    if (C) residual += stage.damping * (*C * (u - stage.q));
    leave_out(system.held(), residual);
    if (!residual.allFinite()) return {"the solid turns inside out: its elements are crushed within the step"};
    // One correction solves a linear system. Of ill-conditioned ones, nearly incompressible solids, roundoff leaves more, and
    // further corrections leave as much again.
    const double left = residual.norm();
    if (k == 0) first = left;
    if (k > 0 && system.linear() && (left <= solved * first || (left > 0.5 * before && left < 0.01 * first))) return {};
    before = left;
    if (!factor_tangent(system, stage, C, u)) return {"the solid's equations are singular: it buckles, or is not held"};
    const Field correction = factor_.solve(residual);
    u -= correction;
    const double size = correction.cwiseAbs().maxCoeff(), way = (u - start).cwiseAbs().maxCoeff();
    if (!std::isfinite(size)) return {"the solid's equations are singular: it buckles, or is not held"};
    // Of ill-conditioned equations corrections stay at their roundoff; a thousandth of the way is near enough to tell.
    const bool stays = size > 0.5 * last && size < 1e-3 * limits_.tolerance * system.length();
    if (size <= limits_.tolerance * way + roundoff || stays) {
      ++iterations_;
      return {};
    }
    last = size;
  }
  return {"the solid's equations do not converge"};
}

}  // namespace splashdown::elastic
