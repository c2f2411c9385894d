#include "rigid/motions.hpp"

#include <algorithm>

#include "core/dense.hpp"

namespace splashdown::rigid {

namespace {

// Conditions and velocities this much smaller than others are roundoff.
constexpr double negligible = 1e-10;

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<char>& chosen) {
  Eigen::MatrixXd rows(std::count(chosen.begin(), chosen.end(), 1), all.cols());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) rows.row(next++) = all.row(static_cast<Eigen::Index>(i));
  return rows;
}

}  // namespace

Motions::Motions(const Problem& p) : unit_(p.unit), resolution_(p.resolution) {
  const auto scaled = p.unit.cwiseInverse().asDiagonal();
  const algebra::Solutions free =
      algebra::solutions_of(p.equalities * scaled, p.equal - p.equalities * p.before, negligible);
  origin_ = p.before + scaled * free.point;
  basis_ = free.directions;
  modes_ = scaled * basis_;
  inertia_ = algebra::congruence(p.inertia, modes_);
  known_ = modes_.transpose() * (p.impulse - p.inertia * (origin_ - p.before));
  contacts_ = p.contacts * modes_;
  least_ = p.least - p.contacts * origin_;
  closed_.assign(static_cast<std::size_t>(contacts_.rows()), 0);
  restrict();
}

void Motions::restrict() {
  const algebra::Solutions left =
      algebra::solutions_of(rows_of(contacts_, closed_), rows_of(least_, closed_), negligible);
  pushed_ = left.point;
  directions_ = left.directions;
}

Eigen::VectorXd Motions::amplitudes(const Eigen::VectorXd& velocity) const {
  return basis_.transpose() * unit_.cwiseProduct(velocity - origin_);
}

Eigen::VectorXd Motions::velocity(const Eigen::VectorXd& impulse) const {
  if (directions_.cols() == 0) return origin_ + modes_ * pushed_;
  const Eigen::VectorXd left = directions_.transpose() * (known_ + modes_.transpose() * impulse - inertia_ * pushed_);
  const Eigen::MatrixXd inertia = algebra::congruence(inertia_, directions_);
  const Eigen::VectorXd w = algebra::least_squares(inertia, left);
  return origin_ + modes_ * (pushed_ + directions_ * w);
}

Eigen::VectorXd Motions::unspent(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse) const {
  return known_ + modes_.transpose() * impulse - inertia_ * amplitudes(velocity);
}

bool Motions::update_contacts(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse) {
  if (closed_.empty()) return false;
  const Eigen::VectorXd y = amplitudes(velocity), rate = contacts_ * y - least_;
  // Impulses r of the closed contacts: D^T r balances what is left.
  const Eigen::VectorXd left = -unspent(velocity, impulse);
  const Eigen::MatrixXd closed = rows_of(contacts_, closed_);
  Eigen::VectorXd pushes(closed.rows());
  if (closed.rows() > 0) pushes = algebra::least_squares(closed.transpose(), left);
  const double weak = negligible * pushes.cwiseAbs().sum();
  const double slow = resolution_ + negligible * contacts_.rowwise().norm().maxCoeff() * y.norm();
  constexpr int together = 5;
  bool changed = false;
  Eigen::Index push = 0;
  for (std::size_t i = 0; i < closed_.size() && !(changed && contact_changes_ >= together); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    // Of contacts that cannot all be closed at once, those that the compromise leaves apart open.
    const bool opens = closed_[i] && (pushes[push] < -weak || rate[row] > slow);
    const bool closes = !closed_[i] && rate[row] < -slow;
    if (closed_[i]) ++push;
    if (!opens && !closes) continue;
    closed_[i] = !closed_[i];
    changed = true;
  }
  if (changed) {
    restrict();
    ++contact_changes_;
  }
  return changed;
}

}  // namespace splashdown::rigid
