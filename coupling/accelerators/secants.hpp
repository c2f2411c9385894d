// Pairs of differences between passes, from which quasi-Newton schemes learn the map's slope:
//
//   V = [r_j - r_{j-1}],   W = [G(x_j) - G(x_{j-1})],   newest first
//
// and the least-squares problem min |r - V c| on those columns of V that are independent. Columns are
// orthogonalised newest first; one that keeps less than a given share of its length is dropped (QR2 filter:
// Haelterman, Bogaers, Scheufele, Uekermann, Mehl 2016), so old and equal columns cannot spoil new ones.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <iosfwd>
#include <optional>

namespace splashdown::coupling {

/// A column of V and of W.
struct Secant {
  Eigen::VectorXd residual;  ///< r_j - r_{j-1} [m/s]
  Eigen::VectorXd image;     ///< G(x_j) - G(x_{j-1}) [m/s]
  /// Share of its length that must be left of the residual, otherwise it is dependent. Below it is what truncated solves and the
  /// curvature of a pass leave.
  double kept = 1e-6;
};

/// The columns of V and W, newest first.
class Secants {
 public:
  /// Newest first. Returns false and drops a pair that carries no information: not finite, or no change.
  bool add(Secant pair);
  /// Appends older ones behind those that are there, under a stricter filter.
  void append(const Secants& older, double kept);
  void keep_newest(std::size_t count);  ///< drops all older ones
  /// Drops all.
  void clear() { pairs_.clear(); }
  /// Number of columns.
  std::size_t size() const { return pairs_.size(); }

  /// V c and W c for c = argmin |r - V c|. Drops dependent columns for good. Nothing if no column is left.
  std::optional<Secant> explain(const Eigen::VectorXd& residual);

  void save(std::ostream& out) const;  ///< bit exact
  void load(std::istream& in);         ///< what `save` wrote; throws std::runtime_error for lengths beyond the bytes

 private:
  std::deque<Secant> pairs_;
};

}  // namespace splashdown::coupling
