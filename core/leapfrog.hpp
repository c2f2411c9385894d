// Leapfrog in time (Stoermer-Verlet): positions and forces at t_n, velocities at t_{n-1/2} and t_{n+1/2}.
//
//   v_{n+1/2} = v_{n-1/2} + kick a_n,   x_{n+1} = x_n + dt_n v_{n+1/2}
//
// Second order where the step changes smoothly (Hairer, Lubich, Wanner, Acta Numerica 12, 2003).
#pragma once

namespace splashdown {

/// Interval over which a force of t_n changes velocities, (dt_{n-1} + dt_n) / 2 [s].
inline double kick(double dt_before, double dt) { return 0.5 * (dt_before + dt); }

/// v_n = v_{n-1/2} + dt_{n-1} / (dt_{n-1} + dt_n) (v_{n+1/2} - v_{n-1/2}): linear between the half steps.
template <class Velocity>
Velocity velocity_at_t_n(const Velocity& before, const Velocity& after, double dt_before, double dt) {
  return before + dt_before / (dt_before + dt) * (after - before);
}

}  // namespace splashdown
