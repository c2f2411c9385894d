// The part without divergence of a field of forces in a box, in a plane without end: P f = curl psi, -Laplace_5 psi =
// curl f. With the lattice's fundamental solution P is a projector to roundoff, P P = P, and symmetric.
#pragma once

#include <vector>

#include "fluid/vortex/poisson/convolution.hpp"

namespace splashdown::vortex {

/// P on a box of one size.
class BoxProjection {
 public:
  BoxProjection(int width, int height);  ///< nodes of the box
  /// u += P f on all faces of the box. Fields are indexed by node of the box, row by row; f is zero on faces beyond it.
  void add(const std::vector<double>& fu, const std::vector<double>& fv, std::vector<double>& u,
           std::vector<double>& v);

 private:
  Convolution sums_;
};

}  // namespace splashdown::vortex
