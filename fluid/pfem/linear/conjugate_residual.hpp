// Conjugate residuals (Stiefel 1955) with a preconditioner, where the operator is known by what it does alone.
//
// J x = r, J symmetric and near to A. Of an iterate x the residual r and z = A^-1 r are known. Its trial x + z leaves r_t and
// z_t = A^-1 r_t, hence J z = r - r_t and A^-1 J z = z - z_t: one J and one A^-1 a step. With the last step p,
//
//   p' = a z + b p,   (a, b) = argmin |r - a J z - b J p| in the norm of A^-1
//   x <- x + p',   r <- r - J p',   z <- z - A^-1 J p'
//
// is the best of all combinations of the steps so far, where J is linear: k steps leave 2 ((sqrt c - 1) / (sqrt c + 1))^k,
// c the condition of A^-1 J, where k corrections by z alone leave (1 - 1/c)^k; and where J is far above A, it is cut instead of
// growing. Where J is not quite linear the trial, which is evaluated, counts almost alone (a = 1).
#pragma once

#include <utility>

namespace splashdown::fluid {

/// `Vector`: r and z together, and whatever else is linear in r; it has
///   double dot(const Vector&) const   r^T A^-1 r' of two
///   void add(double, const Vector&)   r += share r'
template <class Vector>
class ConjugateResidual {
 public:
  /// Begins at an iterate that leaves this.
  explicit ConjugateResidual(Vector left) : left_(std::move(left)) {}

  /// What the iterate leaves: what its trial goes by.
  const Vector& left() const { return left_; }

  /// r^T A^-1 r of it
  double size() const { return left_.dot(left_); }

  /// Takes a step when the trial leaves `trial`: the iterate moves on by last() from where it was.
  void step(const Vector& trial) {
    Vector taken = left_;
    taken.add(-1, trial);
    const double zz = taken.dot(taken), rz = taken.dot(left_);
    double a = zz > 0 ? rz / zz : 1.0, b = 0;
    if (begun_) {
      const double zp = taken.dot(taken_), pp = taken_.dot(taken_), rp = taken_.dot(left_);
      constexpr double parallel = 1e-10;  // directions that differ by roundoff alone
      if (const double det = zz * pp - zp * zp; det > parallel * zz * pp)
        a = (rz * pp - rp * zp) / det, b = (rp * zz - rz * zp) / det;
    }
    if (begun_) {
      scale(last_, b), scale(taken_, b);
      last_.add(a, left_);
      taken_.add(a, taken);
    } else {
      last_ = left_, taken_ = std::move(taken);
      scale(last_, a), scale(taken_, a);
      begun_ = true;
    }
    share_ = a;
    left_.add(-1, taken_);
  }

  /// The last step.
  const Vector& last() const { return last_; }
  /// Of a trial that the last step took.
  double share() const { return share_; }

 private:
  static void scale(Vector& v, double by) { v.add(by - 1, Vector(v)); }

  Vector left_, last_, taken_;
  double share_ = 1;
  bool begun_ = false;
};

}  // namespace splashdown::fluid
