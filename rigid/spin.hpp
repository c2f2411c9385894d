// Rotation of a free body with any inertia. Internal to the rigid-body room.
//
//   L_{n+1/2} = L_{n-1/2} + kick M_n,   J(R_{n+1/2}) w_{n+1/2} = L_{n+1/2},   J(R) = R I R^T
//   R_{n+1/2} = exp(dt/2 w_{n+1/2}) R_n,   R_{n+1} = exp(dt w_{n+1/2}) R_n
//
// The Lie midpoint rule (Krysl, Endres 2005; Simo, Wong 1991): second order, time reversible, keeps the
// angular momentum to round-off and the energy without drift. Bullet's gyroscopic term is an implicit
// Euler step that loses energy at first order; it is off.
//
// The momentum L is the state, not w: the fluid's load enters with J taken at the midpoint that the other
// forces alone would lead to, so that w is affine in the load with a symmetric compliance. That costs an
// error O(dt^2) in w that does not accumulate; with w as the state it would.
#pragma once

#include <array>

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// The shortest rotation vector of a rotation matrix [rad].
Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);

/// J = R I R^T: the inertia in world axes [kg m^2].
Eigen::Matrix3d world_inertia(const Eigen::Matrix3d& rotation, const Eigen::Matrix3d& inertia);

/// Angular velocity change per unit angular impulse when only the free world axes can turn: the inverse of
/// the free block of the inertia (not the free block of the inverse), zero elsewhere.
Eigen::Matrix3d rotational_compliance(const Eigen::Matrix3d& inertia, const std::array<bool, 3>& free);

/// Rotation of a body before a step, world axes.
struct SpinState {
  Eigen::Matrix3d rotation;  ///< R_n, body axes to world
  Eigen::Vector3d velocity;  ///< w_{n-1/2}
  Eigen::Vector3d momentum;  ///< L_{n-1/2}
};

/// What the midpoint rule makes of it.
struct SpinStep {
  Eigen::Vector3d velocity;  ///< w_{n+1/2}; held axes keep theirs
  Eigen::Matrix3d inertia;   ///< J(R_{n+1/2})
};

/// The midpoint rule's step of size dt after an angular impulse at t_n.
SpinStep spin_step(const Eigen::Matrix3d& inertia, const std::array<bool, 3>& free, const SpinState& before,
                   const Eigen::Vector3d& impulse, double dt);

}  // namespace splashdown::rigid
