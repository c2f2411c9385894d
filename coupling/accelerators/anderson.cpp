#include "coupling/accelerators/quasi_newton.hpp"

namespace splashdown::coupling {
Anderson::Anderson(double factor, std::size_t depth) : factor_(factor), depth_(depth) {}

void Anderson::begin_step() {
  secants_.clear();
  residual_.resize(0);
}

Eigen::VectorXd Anderson::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) {
  const Eigen::VectorXd residual = image - x;
  if (residual_.size() == residual.size()) secants_.add({.residual = residual - residual_, .image = image - image_});
  residual_ = residual;
  image_ = image;
  secants_.keep_newest(depth_);
  const auto explained = secants_.explain(residual);
  if (!explained) return x + factor_ * residual;
  const Eigen::VectorXd left = residual - explained->residual;
  return image - explained->image - (1 - factor_) * left;
}

}  // namespace splashdown::coupling
