// A sequence x + c(x) whose changes are mixed so that it converges faster (Anderson 1965; Walker & Ni 2011): of a Newton method
// whose slope is an old one, this is what GMRES is to a linear system with that slope as its preconditioner.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace splashdown {

/// Made anew where the slope changes.
class Mixing {
 public:
  /// `counted`: how many of the first numbers decide what is mixed.
  explicit Mixing(Eigen::Index counted) : counted_(counted) {}
  /// The way to go, where a step of the sequence would go by c.
  Eigen::VectorXd way(const Eigen::VectorXd& c);
  /// Forgets what it has seen.
  void forget();

 private:
  Eigen::Index counted_;
  Eigen::VectorXd last_way_, last_change_;
  std::vector<Eigen::VectorXd> ways_, changes_;  // differences, the oldest first
};

}  // namespace splashdown
