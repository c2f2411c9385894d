// Where cells are integrated: seven points, exact for polynomials of degree 5 (Radon 1948), what convection needs on straight
// cells, with the shape functions there.
#pragma once

#include <array>
#include <cmath>

#include "core/simplices/quadratic.hpp"

namespace splashdown::ale {

/// Shape functions at a point of the rule.
struct CellPoint {
  Barycentric<2> L;                    ///< linear
  Eigen::Matrix<double, 6, 1> N;       ///< quadratic
  Eigen::Matrix<double, 2, 6> slopes;  ///< by the coordinates of corners 1 and 2
  double weight = 0;                   ///< share of the reference triangle, whose area is 1/2
};

/// Shape functions at a place of a cell.
inline CellPoint cell_point(const Barycentric<2>& at, double weight) {
  return {at, shapes<2>(at), shape_slopes<2>(at), weight};
}

/// The rule.
inline const std::array<CellPoint, 7>& cell_rule() {
  static const auto points = [] {
    const double root = std::sqrt(15.), third = 1. / 3;
    std::array<CellPoint, 7> all;
    all[0] = cell_point(Barycentric<2>::Constant(third), 0.5 * 9. / 40);
    for (int k = 0; k < 3; ++k)
      for (int sign = 0; sign < 2; ++sign) {
        const double a = (6 + (sign ? 1 : -1) * root) / 21, weight = (155 + (sign ? 1 : -1) * root) / 1200;
        Barycentric<2> at = Barycentric<2>::Constant(a);
        at[k] = 1 - 2 * a;
        all[static_cast<std::size_t>(1 + 2 * k + sign)] = cell_point(at, 0.5 * weight);
      }
    return all;
  }();
  return points;
}

}  // namespace splashdown::ale
