// Vortices move with the flow, d omega/dt + div(u omega) = 0: particles start at the nodes, move along x for half a
// step, along y for a whole one and along x again (Strang 1968), and give their circulation back to the nodes by a
// kernel of one dimension after each move (Magni & Cottet, J. Comput. Phys. 231, 2012). Second order; circulation is
// kept to roundoff but for what leaves the grid.
#pragma once

#include "fluid/vortex/grid.hpp"

namespace splashdown::vortex {

/// What gives particles back to the grid (kernels.hpp).
enum class Remeshing { m4, m6 };
/// How particles' paths are integrated along an axis: midpoint rule, or Runge and Kutta's rule of four stages.
enum class PathRule { rk2, rk4 };

/// A velocity in the middle of a step, now + ahead (now - before).
struct MidVelocity {
  const FaceField& now;
  const FaceField& before;
  double ahead = 0;
};

/// Moves vorticity over a grid.
class Advection {
 public:
  /// Keeps nothing of the fields that it moves.
  Advection(const Grid& grid, Remeshing kernel, PathRule rule) : grid_(grid), kernel_(kernel), rule_(rule) {}
  /// Moves omega for dt [s]. No particle may cross more than a square in a move: |u| dt <= h. Vorticity on the sides
  /// is dropped.
  void move(NodeField& omega, const MidVelocity& velocity, double dt);

 private:
  void along_x(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const;
  void along_y(const MidVelocity& velocity, double dt, const NodeField& omega, NodeField& moved) const;

  Grid grid_;
  Remeshing kernel_;
  PathRule rule_;
  NodeField moved_;
};

}  // namespace splashdown::vortex
