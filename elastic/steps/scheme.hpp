// Schemes for M a + C v + f(u) = F(t), from t_n to t_{n+1} = t_n + dt. With f_n = f(u_n) and so on:
//
//   generalised-alpha (Chung, Hulbert 1993), by the spectral radius r at infinite frequency; order 2
//       M a_{n+1-am} + C v_{n+1-af} + (1-af) f_{n+1} + af f_n = F_{n+1-af},   am = (2r-1)/(r+1),   af = r/(r+1)
//       with Newmark's u_{n+1}, v_{n+1} of gamma = 1/2 - am + af, beta = (1 - am + af)^2/4
//   Newmark (1959): am = af = 0. With beta = 1/4, gamma = 1/2 of order 2; it keeps the energy of linear solids exactly
//   one-step theta:  u_{n+1} - u_n = dt (th v_{n+1} + (1-th) v_n),   M (v_{n+1} - v_n) = dt (th r_{n+1} + (1-th) r_n),
//       r = F - C v - f:  implicit Euler th = 1, order 1;  shifted Crank-Nicolson th = 1/2 + s dt, order 2
//   fractional-step theta (Bristeau, Glowinski, Periaux 1987): three one-step thetas with lengths th, 1-2th, th of dt and
//       weights a, 1-a, a;  th = 1 - 1/sqrt(2), a = (1-2th)/(1-th); order 2, strongly stable
//   midpoint: implicit Euler to the middle, and on along the same line; order 2. Keeps momenta exactly, also in rotations, and
//       the energy of linear solids
//   steady: f_{n+1} = F_{n+1}, without inertia; loads go up in parts where Newton's method asks for it
//
// C = alpha M + beta K is taken at u_n + dt v_n/2, so that it is linear within a step.
#pragma once

#include <functional>
#include <memory>

#include "elastic/steps/stage.hpp"

namespace splashdown::elastic {

/// A state at an instant.
struct SolidState {
  double t = 0;   ///< [s]
  Field u, v, a;  ///< displacement, velocity, acceleration [m, m/s, m/s^2]
};

/// C = mass * M + stiffness * K. A mode of frequency w is damped by (mass/w + stiffness w)/2 of the critical.
struct Rayleigh {
  double mass = 0;       ///< alpha [1/s]
  double stiffness = 0;  ///< beta [s]
};

/// What moves, what slows it down and what drives it.
struct Dynamics {
  const System* system = nullptr;
  Rayleigh damping = {};
  std::function<Field(double)> load;  ///< F at a time [N, N/m]; of held unknowns it does not matter
  NewtonLimits newton = {};
  /// Velocities of held unknowns at a time [m/s], zero for those that stay; empty: all stay. Walls alone obey it.
  std::function<Field(double)> drive = {};
  /// c: damps what steps do not resolve (walls/wall.hpp). Walls alone.
  double unresolved = 0;
};

/// One scheme on one system.
class Scheme {
 public:
  /// The system is not owned.
  explicit Scheme(Dynamics dynamics) : dynamics_(std::move(dynamics)), solver_(dynamics_.newton) {}
  virtual ~Scheme() = default;
  /// One step from a state that stays as it is; refused with a cause, `next` is then of no use.
  virtual Status step(const SolidState& now, double dt, SolidState& next) = 0;
  /// The accelerations that the state at its instant has.
  virtual Status accelerate(SolidState& motion);
  /// Newton iterations so far: each assembles, factors and solves once.
  long iterations() const { return solver_.iterations(); }
  /// What it was made from.
  const Dynamics& dynamics() const { return dynamics_; }

 protected:
  /// C at u + half * v; null: there is none.
  const Sparse* damping_at(const SolidState& now, double half);
  /// That it moves.
  const System& system() const { return *dynamics_.system; }

  Dynamics dynamics_;
  StageSolver solver_;

 private:
  Sparse C_;
};

/// All throw std::invalid_argument for parameters outside of their range.
/// `radius` of 0 to 1: what is left in a step of what is infinitely fast.
std::unique_ptr<Scheme> generalised_alpha(Dynamics dynamics, double radius);
/// beta > 0, gamma >= 1/2.
std::unique_ptr<Scheme> newmark(Dynamics dynamics, double beta = 0.25, double gamma = 0.5);
/// `shift` s >= 0 [1/s].
std::unique_ptr<Scheme> shifted_crank_nicolson(Dynamics dynamics, double shift);
/// Three systems a step.
std::unique_ptr<Scheme> fractional_step_theta(Dynamics dynamics);
/// For comparison, and to come to rest.
std::unique_ptr<Scheme> implicit_euler(Dynamics dynamics);
/// For free flight.
std::unique_ptr<Scheme> midpoint(Dynamics dynamics);
/// Equilibria under loads that change slowly.
std::unique_ptr<Scheme> steady(Dynamics dynamics);

}  // namespace splashdown::elastic
