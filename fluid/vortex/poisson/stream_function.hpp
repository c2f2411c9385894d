// Diffusion and stream function together, by one sine transform there and back (its eigenvalues make both diagonal):
//
//   omega <- exp(nu dt L) omega,   -Laplace_5 psi = omega,   psi given on the sides
//
// L is the five-point Laplacian, or of fourth order its twin with -(h^2/12) (d_x^4 + d_y^4); vorticity on the sides
// is zero. Sides of a plane without end: far_field.hpp. Sides that nothing passes but the stream: psi = 0.
#pragma once

#include <optional>
#include <vector>

#include "fluid/vortex/grid.hpp"
#include "fluid/vortex/poisson/far_field.hpp"
#include "fluid/vortex/poisson/sine_transform.hpp"

namespace splashdown::vortex {

/// What the grid's sides are to the flow besides the stream.
enum class SideKind {
  free,  ///< none: the plane goes on
  slip   ///< only the stream passes, without friction
};

/// Solver for one grid.
class StreamFunction {
 public:
  /// `order`: of diffusion, 2 or 4.
  StreamFunction(const Grid& grid, SideKind sides, int order = 2);
  /// omega diffuses by `spread` = nu dt [m^2] and is given back as -Laplace_5 psi; 0: as it was, to roundoff.
  void solve(NodeField& omega, double spread, NodeField& psi);

 private:
  void load(const NodeField& omega);
  void add_sides();
  void divide(double spread);
  void store(NodeField& omega, NodeField& psi) const;

  Grid grid_;
  mutable SineTransform transform_;
  std::optional<FarField> far_;
  Sides sides_, spectra_;
  int order_;
  std::vector<double> lambda_x_, lambda_y_, decay_x_, decay_y_, sine_x_, sine_y_;
};

}  // namespace splashdown::vortex
