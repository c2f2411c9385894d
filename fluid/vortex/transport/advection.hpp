// Vortices move with the flow, d omega/dt + div(u omega) = 0: particles start at the nodes, move along x for half a
// step, along y for a whole one and along x again (Strang 1968), and give their circulation back to the nodes by a
// kernel of one dimension after each move (Magni & Cottet, J. Comput. Phys. 231, 2012). Second order; circulation is
// kept to roundoff but for what leaves the grid.
#pragma once

#include "fluid/vortex/grid.hpp"
#include "fluid/vortex/transport/shares.hpp"

namespace splashdown::vortex {

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
  /// omega after dt [s], in another field. No particle may cross more than a square in a move: |u| dt <= h. Vorticity on the
  /// sides is dropped.
  void move(const NodeField& omega, const MidVelocity& velocity, double dt, NodeField& moved) const;

 private:
  Grid grid_;
  Remeshing kernel_;
  PathRule rule_;
};

}  // namespace splashdown::vortex
