#include <cmath>

#include "coupling/accelerators/accelerator.hpp"

namespace splashdown::coupling {

void Aitken::begin_step() {
  factor_ = first_;
  residual_.resize(0);
}

Eigen::VectorXd Aitken::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) {
  const Eigen::VectorXd residual = image - x;
  if (residual_.size() == residual.size()) {
    const Eigen::VectorXd change = residual - residual_;
    const double squared = change.squaredNorm();
    // Identical residuals carry no information, nor do those too large to square: keep the factor.
    if (squared > 0 && std::isfinite(squared)) factor_ = -factor_ * residual_.dot(change) / squared;
  }
  residual_ = residual;
  return x + factor_ * residual;
}

}  // namespace splashdown::coupling
