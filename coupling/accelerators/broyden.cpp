#include <cmath>

#include "coupling/accelerators/quasi_newton.hpp"

namespace splashdown::coupling {
namespace {

// Below this the updated Jacobian is singular to half of a double's digits: the update is left out.
constexpr double singular = 1e-8;

}  // namespace

void Broyden::begin_step() {
  updates_.clear();
  residual_.resize(0);
}

Eigen::VectorXd Broyden::inverse_times(const Eigen::VectorXd& r) const {
  Eigen::VectorXd y = -factor_ * r;
  for (const auto& u : updates_) y += u.left * u.right.dot(r);
  return y;
}

Eigen::VectorXd Broyden::inverse_transposed_times(const Eigen::VectorXd& r) const {
  Eigen::VectorXd y = -factor_ * r;
  for (const auto& u : updates_) y += u.right * u.left.dot(r);
  return y;
}

Eigen::VectorXd Broyden::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) {
  const Eigen::VectorXd residual = image - x;
  if (residual_.size() == residual.size()) {
    const Eigen::VectorXd X = x - x_, V = residual - residual_;
    const Eigen::VectorXd step = inverse_times(V), right = inverse_transposed_times(X);
    const double pivot = X.dot(step);
    if (std::abs(pivot) > singular * X.norm() * step.norm()) updates_.push_back({(X - step) / pivot, right});
  }
  residual_ = residual;
  x_ = x;
  const Eigen::VectorXd next = x - inverse_times(residual);
  return next.allFinite() ? next : Eigen::VectorXd(x + factor_ * residual);
}

}  // namespace splashdown::coupling
