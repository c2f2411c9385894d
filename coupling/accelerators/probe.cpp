#include "coupling/accelerators/quasi_newton.hpp"

namespace splashdown::coupling {

void Probe::begin_step() {
  passes_.begin_step();
  left_ = {};
}

void Probe::set_slope(const Eigen::MatrixXd& slope) {
  left_.compute(Eigen::MatrixXd::Identity(slope.rows(), slope.cols()) - slope);
}

Eigen::VectorXd Probe::next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) {
  if (left_.rows() != x.size()) return passes_.next(x, image);
  return passes_.next(x, x + left_.solve(image - x));
}

}  // namespace splashdown::coupling
