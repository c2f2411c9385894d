// Generalised conjugate residuals (Eisenstat, Elman, Schultz 1983) with a preconditioner, where the operator is known by what it
// does alone and need not be symmetric.
//
// J x = r; of an iterate x the residual r and z = A^-1 r are known. Its trial x + z leaves r_t, hence J z = r - r_t. Made
// orthogonal to what the steps so far have taken, q_j = J p_j, in the norm of A^-1,
//
//   p = z - sum_j b_j p_j,   q = J z - sum_j b_j q_j,   x <- x + a p,   r <- r - a q,   a = (r, q) / (q, q)
//
// leaves the least that combinations of the steps can leave. One J and one A^-1 a step, as conjugate_residual.hpp, whose
// interface it has; it remembers all steps.
#pragma once

#include <utility>
#include <vector>

namespace splashdown::fluid {

/// `Vector`: r and z together, and whatever else is linear in r; it has
///   double dot(const Vector&) const   r^T A^-1 r' of two
///   void add(double, const Vector&)   r += share r'
template <class Vector>
class GeneralisedConjugateResidual {
 public:
  /// Begins at an iterate that leaves this.
  explicit GeneralisedConjugateResidual(Vector left) : left_(std::move(left)) {}

  /// What the iterate leaves: what its trial goes by.
  const Vector& left() const { return left_; }

  /// r^T A^-1 r of it
  double size() const { return left_.dot(left_); }

  /// Takes a step when the trial leaves `trial`: the iterate moves on by last() from where it was.
  void step(const Vector& trial) {
    Vector moves = left_, takes = left_;
    takes.add(-1, trial);
    for (const Step& before : steps_) {
      const double share = takes.dot(before.takes) / before.squared;
      moves.add(-share, before.moves);
      takes.add(-share, before.takes);
    }
    const double squared = takes.dot(takes);
    const double share = squared > 0 ? left_.dot(takes) / squared : 0.0;
    left_.add(-share, takes);
    last_ = moves;
    last_.add(share - 1, moves);
    if (squared > 0) steps_.push_back({std::move(moves), std::move(takes), squared});
  }

  /// The last step.
  const Vector& last() const { return last_; }

 private:
  struct Step {
    Vector moves, takes;  // p, q
    double squared;       // (q, q)
  };
  Vector left_, last_;
  std::vector<Step> steps_;
};

}  // namespace splashdown::fluid
