// Values over an angle or a time, as tables give them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace splashdown::rigid {

/// Piecewise linear through rows of ascending abscissae; constant before the first and after the last. One row: a constant. None:
/// zero.
template <int values>
class Curve {
 public:
  /// A point of it.
  struct Row {
    double at = 0;                                                                      ///< angle [rad] or time [s]
    Eigen::Matrix<double, values, 1> value = Eigen::Matrix<double, values, 1>::Zero();  ///< there
  };
  Curve() = default;
  /// Rows in ascending x.
  explicit Curve(std::vector<Row> rows) : rows_(std::move(rows)) {}

  /// Without rows it is no curve.
  bool empty() const { return rows_.empty(); }
  /// Linear between the rows, and as at the ends beyond them.
  Eigen::Matrix<double, values, 1> at(double x) const;
  double largest() const;   ///< of all values' norms
  double steepest() const;  ///< of all slopes' norms

 private:
  std::vector<Row> rows_;
};

extern template class Curve<1>;
extern template class Curve<2>;
extern template class Curve<3>;

}  // namespace splashdown::rigid
