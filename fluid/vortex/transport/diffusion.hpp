// Vorticity diffuses for a step, omega <- exp(nu dt L) omega, with zero on the sides. L is the five-point Laplacian, or of
// fourth order its twin with -(h^2/12)(d_x^4 + d_y^4). Its exponential is a product of two sums of one dimension,
//
//   omega_i <- sum_n c_n omega_{i+n},   c_n = (1/2 pi) int exp(-nu dt lambda(k)) cos(n k) dk,
//
// cut where 1e-13 is left. Circulation is kept to roundoff but for what reaches the sides.
#pragma once

#include <vector>

#include "fluid/vortex/grid.hpp"

namespace splashdown::vortex {

/// Diffuses fields on one grid.
class Diffusion {
 public:
  /// `order`: 2 or 4.
  Diffusion(const Grid& grid, int order) : grid_(grid), order_(order) {}
  /// `spread` = nu dt [m^2]. Of the result, what is below `nothing` [1/s] becomes zero: rims of fields would fade
  /// through numbers that no machine is fast with.
  void apply(NodeField& omega, double spread, double nothing);

 private:
  class Rows;
  void prepare(double spread);

  Grid grid_;
  int order_;
  double prepared_ = -1;        // spread that the kernel is for
  int pieces_ = 1;              // that it is divided into
  std::vector<double> kernel_;  // c_0, c_1 ...
  NodeField spread_;
};

}  // namespace splashdown::vortex
