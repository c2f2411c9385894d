// Forces along a coordinate of one body or two that are implicit in the velocities which a step leads to: springs and dampers of
// lines. They are part of a step's equations, so that no step is too long for them.
//
//   J = J_0 + K dq/dt_{n+1/2},  one-sided: J = max(0, J_0 + K dq/dt_{n+1/2})     impulse over the kick, against q
//
// A one-sided one is a contact that yields (constraints/constraint_solver.hpp). A spring T(q) = k max(q, 0) is taken at the
// middles of steps, q_- = q_n - dt_{n-1} dq/dt_{n-1/2}/2 and q_+ = q_n + dt_n dq/dt_{n+1/2}/2,
//
//   J = kick k (q_+ + max(q_-, 0))/2
//
// which is Newmark's rule with beta = 1/4 while it is taut, and takes at least what it stores from what stretches it, so that it
// adds no energy however it comes taut or goes slack within a step.
#pragma once

#include <span>

#include "rigid/body.hpp"
#include "rigid/joint.hpp"

namespace splashdown::rigid {

/// One such force.
template <int d>
struct Pull {
  Condition<d> rate;      ///< dq/dt = first . s_body + second . s_other; its right side means nothing
  double impulse = 0;     ///< J_0 [N s]
  double inertia = 0;     ///< K [kg]; positive for one-sided ones
  bool one_sided = true;  ///< J >= 0

  /// J with dq/dt = `later` at t_{n+1/2} [m/s].
  double at(double later) const;
};

/// A spring and a damper along q.
struct Stretch {
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
};

/// Where q and its rate are when a step begins.
struct StretchAt {
  double q = 0;           ///< at t_n; positive: taut [m]
  double rate = 0;        ///< dq/dt at t_{n-1/2} [m/s]
  double kick = 0;        ///< of the step [s]
  double dt = 0;          ///< the same [s]
  double compliance = 0;  ///< of bodies along q: dq/dt that a unit impulse gives [1/kg]
};

/// J_0 and K of a one-sided spring and damper; `rate` is left to the caller.
template <int d>
Pull<d> tension_only(const Stretch& spring, const StretchAt& at);

/// dq/dt that a unit impulse along it gives bodies in the void that forces move [1/kg]; infinite without mass. Held freedoms
/// count as free.
template <int d>
double compliance(const Condition<d>& rate, std::span<const BodySpec<d>> specs, std::span<const BodyState<d>> states,
                  std::span<const char> held);

/// Weight of the later one of two velocities for which the step's damping of a mass, exp(-z) after z = c dt/m, is exact
/// (exponential fitting, Liniger and Willoughby 1970): 1/2 + z/12 + ... to 1.
double weight_of_later(double z);

}  // namespace splashdown::rigid
