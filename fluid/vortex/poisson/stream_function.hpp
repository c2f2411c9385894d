// The stream function of a vorticity, -Laplace_5 psi = omega at the inner nodes, psi given on the sides: a sine transform
// of each row, a chain of equations along y for each mode, and the transform back. Sides of a plane without end:
// far_field.hpp. Sides that nothing passes but the stream: psi = 0.
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
  /// Plans and factors for this grid.
  StreamFunction(const Grid& grid, SideKind sides);
  /// Makes of a vorticity [1/s] its psi at all nodes [m^2/s]. `beyond`: of vorticity outside of the grid, on free sides.
  void solve(NodeField& field, const Sides* beyond = nullptr);
  /// The same into another field.
  void solve(const NodeField& omega, NodeField& psi) {
    psi = omega;
    solve(psi);
  }

 private:
  /// Factors of the chains of some neighbouring modes, (2 + h^2 lambda - c_{j-1}) c_j = 1, until they no longer change.
  struct Chain {
    std::size_t first, count, rows;
    std::vector<double> factors;
  };

  void add_chain(std::size_t first, std::size_t count, const std::vector<double>& lambda);
  void solve_chain(const Chain& chain, NodeField& psi) const;

  Grid grid_;
  SineTransform transform_;
  std::optional<FarField> far_;
  Sides sides_;
  std::vector<Chain> chains_;
};

}  // namespace splashdown::vortex
