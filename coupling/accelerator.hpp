// Fixed-point accelerators for x = G(x): one scheme a file behind one small interface.
#pragma once

#include <Eigen/Core>
#include <string>

namespace splashdown::coupling {

class Accelerator {
 public:
  virtual ~Accelerator() = default;
  virtual std::string name() const = 0;
  virtual void begin_step() = 0;
  /// Next iterate from x and its image G(x).
  virtual Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) = 0;
};

/// x + w (G(x) - x) with a constant w in (0, 1].
class ConstantRelaxation final : public Accelerator {
 public:
  explicit ConstantRelaxation(double factor) : factor_(factor) {}
  std::string name() const override { return "constant"; }
  void begin_step() override {}
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override {
    return x + factor_ * (image - x);
  }

 private:
  double factor_;
};

/// Aitken's dynamic relaxation (Irons, Tuck 1969; Kuettler, Wall 2008):
///   w_{k+1} = -w_k r_k . (r_{k+1} - r_k) / |r_{k+1} - r_k|^2,  r = G(x) - x
/// The factor of a step's first pass is the last one used, bounded by the given first factor.
class Aitken final : public Accelerator {
 public:
  explicit Aitken(double first) : first_(first), factor_(first) {}
  std::string name() const override { return "aitken"; }
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override;

 private:
  double first_, factor_;
  Eigen::VectorXd residual_;  // of the previous pass; empty in the first
};

}  // namespace splashdown::coupling
