// What a solve has found out about a step.
#pragma once

#include <vector>

#include "core/fluid_view.hpp"
#include "core/status.hpp"
#include "core/wall_vector.hpp"

namespace splashdown::fluid {

using splashdown::AtVertices;
using splashdown::Ledger;
using splashdown::WallLoad;
using splashdown::WallVelocity;

/// All of it world frame, half-step velocities at t_{n+1/2}. Empty but for the status where no solution was found.
template <int d>
struct StepResult {
  Status status;                   ///< why there is no solution; ok: there is one
  std::vector<WallLoad<d>> loads;  ///< on the walls, means over the kick
  /// The same on the vertices of walls that deform, all that acts on them [N; 2D: N/m]; empty for rigid ones.
  std::vector<AtVertices<d>> at_vertices;
  std::vector<WallVelocity<d>> wall_velocities;  ///< half-step velocities that the walls end with
  /// Velocities that impulses left unbalanced in the motions would still give to bodies and water: what the solve fell
  /// short of Newton's law, Z (M + G)^-1 (Z^T impulses - M y).
  std::vector<WallVelocity<d>> imbalance;
  /// Mean physical pressure impulses on the pieces of walls with an interface Laplacian [Pa s].
  std::vector<double> interface_impulse;
  std::vector<double> pressure;  ///< at the nodes at t_n, without what corrections add from node to node [Pa]
  std::vector<double> carried;   ///< with it: what nodes carry to the next step [Pa]
  /// What the repair impulse is as a mean over the kick, at the nodes [Pa]: it loads walls beside the pressure.
  std::vector<double> repair_pressure;
  std::vector<Vec<d>> velocity;  ///< of the nodes, along their walls: half-step
  Ledger ledger;                 ///< at t_n, as far as it is known before the motion
  double power_on_walls = 0;     ///< over the kick [W, W/m]
  /// Of effects that book their work, in their order: what they do to water and walls, means over the kick [W, W/m].
  std::vector<double> power_of_effects;
};

}  // namespace splashdown::fluid
