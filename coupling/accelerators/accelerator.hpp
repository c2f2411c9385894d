// Fixed-point accelerators for x = G(x): one scheme a file behind one small interface.
//
// They see a vector and its image, both in m/s, and know neither fluid nor bodies. Symbols: r = G(x) - x,
// w the relaxation factor. A pass is one evaluation of G. Sources and derivations: docs/design-notes.
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <string>

namespace splashdown::coupling {

/// Finds the next iterate of x = G(x) from those that have been tried. Vectors in m/s, all of one length between `forget`s.
class Accelerator {
 public:
  virtual ~Accelerator() = default;
  virtual std::string name() const = 0;  ///< as scenes call it
  /// Before the first pass of an attempt: forgets what attempts that were not committed have learnt.
  virtual void begin_step() = 0;
  /// Whether it wants dG/dx at the beginning of each attempt, after begin_step().
  virtual bool needs_slope() const { return false; }
  /// dG/dx at t_n, square [-]. Called only if needs_slope().
  virtual void set_slope(const Eigen::MatrixXd&) {}
  /// Next iterate from x and its image G(x).
  virtual Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) = 0;
  /// The attempt became a step: what it has learnt may serve the next one.
  virtual void commit_step() {}
  /// The entries of x mean something else from now on: drops what was learnt in past steps.
  virtual void forget() {}
  /// What lives across steps, bit exact.
  virtual void save(std::ostream&) const {}
  /// What `save` wrote. Throws std::runtime_error for other bytes.
  virtual void load(std::istream&) {}
};

/// x + w r with a constant w in (0, 1].
class ConstantRelaxation final : public Accelerator {
 public:
  /// `factor`: w.
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
///   w_{k+1} = -w_k r_k . (r_{k+1} - r_k) / |r_{k+1} - r_k|^2
/// Every step begins with the given first factor; equal residuals and values that are not finite keep it.
class Aitken final : public Accelerator {
 public:
  /// `first`: w of each step's first pass, in (0, 1].
  explicit Aitken(double first) : first_(first), factor_(first) {}
  std::string name() const override { return "aitken"; }
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override;

 private:
  double first_, factor_;
  Eigen::VectorXd residual_;  // of the previous pass; empty in the first
};

}  // namespace splashdown::coupling
