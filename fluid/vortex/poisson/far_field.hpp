// The stream function on the sides of a rectangle in a plane without end, psi(x) = -1/(2 pi) int log|x - y| omega(y)
// dy: omega is restricted by M'4 to every fourth node, which keeps its moments up to the second, summed there with
// all nodes (convolution.hpp) and interpolated on the sides by polynomials of degree five. Error (4 h / r)^3 of a
// vortex at distance r from a side.
#pragma once

#include <vector>

#include "fluid/vortex/grid.hpp"
#include "fluid/vortex/poisson/convolution.hpp"

namespace splashdown::vortex {

/// Stream function on the sides, corners included.
struct Sides {
  std::vector<double> bottom, top;  ///< nx + 1 numbers
  std::vector<double> left, right;  ///< ny + 1 numbers

  /// Adds so many times those of others, which are as long.
  void add(double times, const Sides& others);
};

/// Values on the sides of a grid.
class FarField {
 public:
  static constexpr int coarsening = 4;  ///< nx and ny have to be multiples
  /// For this grid.
  explicit FarField(const Grid& grid);
  /// Of this vorticity.
  void evaluate(const NodeField& omega, Sides& sides);

 private:
  void restrict_vorticity(const NodeField& omega);

  Grid grid_;
  Convolution sums_;
};

}  // namespace splashdown::vortex
