// Accelerators that learn the map's slope from its passes.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "coupling/accelerators/accelerator.hpp"
#include "coupling/accelerators/secants.hpp"

namespace splashdown::coupling {

/// Anderson mixing (Anderson 1965; Walker, Ni 2011), type II with depth m:
///   x_{k+1} = x_k + w r_k - (X + w V) c,   c = argmin |r_k - V c|
/// X, V: differences of the last m iterates and residuals. On an affine map of n dimensions it is GMRES: the
/// iterate after n + 1 passes is the solution, whatever w, and pass n + 2 finds that it is. Each step begins anew.
class Anderson final : public Accelerator {
 public:
  /// `factor`: w in (0, 1]; `depth`: m.
  explicit Anderson(double factor, std::size_t depth = 50);
  std::string name() const override { return "anderson"; }
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override;

 private:
  double factor_;
  std::size_t depth_;
  Secants secants_;
  Eigen::VectorXd residual_, image_;  // of the previous pass; empty in the first
};

/// Interface quasi-Newton with an inverse Jacobian from least squares (Degroote, Bathe, Vierendeels 2009):
///   x_{k+1} = G(x_k) - W c,   c = argmin |r_k - V c|
/// V, W: differences of residuals and images of this step's passes, and of the last `reuse` steps as long as
/// they are independent of the newer ones (QR2 filter, Haelterman et al. 2016). The first pass of a step without
/// any column is relaxed by w.
class IqnIls final : public Accelerator {
 public:
  /// `factor`: w in (0, 1] of a first pass without columns; `reuse`: committed steps whose columns are kept.
  explicit IqnIls(double factor, std::size_t reuse = 0);
  std::string name() const override { return "iqn_ils"; }
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override;
  void commit_step() override;
  void forget() override { past_.clear(); }
  void save(std::ostream& out) const override;
  /// What `save` wrote. Throws std::runtime_error for other bytes.
  void load(std::istream& in) override;

 private:
  double factor_;
  std::size_t reuse_;
  Secants secants_;           // of this step
  std::deque<Secants> past_;  // of committed steps, newest first
  Eigen::VectorXd residual_, image_;
};

/// Broyden's good method (Broyden 1965) on r(x) = 0:
///   B_{k+1} = B_k + (V - B_k X) X^T / |X|^2,   x_{k+1} = x_k - B_k^-1 r_k,   B_0 = -1/w
/// X, V: change of iterate and residual in the last pass. B^-1 is kept as updates of rank one (Sherman,
/// Morrison 1950). On an affine map of n dimensions it ends within 2 n + 1 passes (Gay 1979).
class Broyden final : public Accelerator {
 public:
  /// `factor`: w in (0, 1], of B_0 = -1/w.
  explicit Broyden(double factor) : factor_(factor) {}
  std::string name() const override { return "broyden"; }
  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override;

 private:
  Eigen::VectorXd inverse_times(const Eigen::VectorXd& r) const;             // B^-1 r
  Eigen::VectorXd inverse_transposed_times(const Eigen::VectorXd& r) const;  // B^-T r
  struct Update {
    Eigen::VectorXd left, right;  // B^-1 += left right^T
  };

  double factor_;
  std::vector<Update> updates_;
  Eigen::VectorXd residual_, x_;
};

/// Newton's method with the slope J = dG/dx that both sides know before the first pass, as in the non-iterative stepper
/// of Roenby, Aliyar, Bredmose (2024):
///   x_2 = x_1 + (1 - J)^-1 r_1
/// The second pass of an affine map is its solution. What a wrong or bent slope leaves, further passes find as
/// `IqnIls` does with (1 - J)^-1 r in the place of r. The first pass is relaxed by w, without a slope like any other.
class Probe final : public Accelerator {
 public:
  /// `factor`: w in (0, 1] of a first pass.
  explicit Probe(double factor) : passes_(factor) {}
  std::string name() const override { return "probe"; }
  void begin_step() override;
  bool needs_slope() const override { return true; }
  /// J = dG/dx, square [-]. Without it, or for vectors of another length, passes are those of `IqnIls`.
  void set_slope(const Eigen::MatrixXd& slope) override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& image) override;

 private:
  IqnIls passes_;
  Eigen::PartialPivLU<Eigen::MatrixXd> left_;  // 1 - J; empty: not known
};

}  // namespace splashdown::coupling
