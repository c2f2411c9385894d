// What nodes of a line get of the particles on it: each starts at a node, moves for a step and gives its circulation to the nodes
// around by a kernel (Magni & Cottet, J. Comput. Phys. 231, 2012).
#pragma once

#include <array>
#include <cstddef>

namespace splashdown::vortex {

/// What gives particles back to the grid (kernels.hpp).
enum class Remeshing { m4, m6 };
/// How particles' paths are integrated along an axis: midpoint rule, or Runge and Kutta's rule of four stages.
enum class PathRule { rk2, rk4 };

/// A kernel with a rule of paths.
class Shares {
 public:
  static constexpr std::size_t most = 7;  ///< of a particle: those of M'6

  /// Velocities along the particles' axis before, at and after each [squares a move].
  struct Velocities {
    const double *before, *here, *after;
  };

  /// Of these.
  Shares(Remeshing kernel, PathRule paths) : kernel_(kernel), paths_(paths) {}
  /// Nodes to either side that a particle gives to.
  std::size_t reach() const { return kernel_ == Remeshing::m4 ? 2 : 3; }
  /// Nodes that it gives to.
  std::size_t count() const { return 2 * reach() + 1; }
  /// Row k of `to`, `pitch` apart: what the node k - reach() beyond each of `count` particles of circulation omega gets.
  void give(const Velocities& v, const double* omega, std::size_t count, std::size_t pitch, double* to) const;
  /// Sums of what particles give to each of `count` nodes: from[k] its first share k.
  void gather(const std::array<const double*, most>& from, std::size_t count, double* to) const;

 private:
  Remeshing kernel_;
  PathRule paths_;
};

}  // namespace splashdown::vortex
