// How a liquid gives way to pressure. With beta = V / (rho c^2) of the water around a node and r the volume that goes there per
// time at t_{n+1/2}, its pressure P at whole steps and the impulse that the water gets of it are
//
//   beta (P_{n+1} - P_n) = dt r,   phi = kick (a P_{n+1} + b P_n + c P_{n-1} + e P_{n-2})
//
// The weights are those of (z + q)^2 (z + (1 - q) / 2 q) over its value at z = 1: of second order, stable however long the step
// is for sound, which then dies by 1 - q a step instead of ringing for ever. With q = 0.95 a wave of 40 steps a period loses
// 0.02 % of its energy in one. Where sound crosses more than two elements in a kick, which leaves it no waves to resolve, q falls
// towards a half. All that has gone to a node comes back, however steps change. Eliminated, r is a diagonal and a source of the
// pressure equation:
//
//   r = C phi - C kick ((a + b) P_n + c P_{n-1} + e P_{n-2}),   C = beta / (a kick dt)
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "fluid/pfem/liquid_state.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Of one step; entries are of nodes unless said.
///
/// The repair makes the carried velocity compress the water as it did on the old mesh, r- = d V with the rate d that nodes
/// carry, and gives way with the same C, r- = d V + C Phi, so that what meets a wall at once is stopped by sound, or at once
/// where the step is long for sound.
///
/// Waves of few elements, which no mesh carries well, are damped by a bulk viscosity zeta = 0.2 rho c h on what the rate differs
/// from its mean over the cells around, explicitly: kick zeta (r- / V - mean) is added to phi; of third order on a wave that
/// elements resolve; where the step is longer than h / 2 c, by as much less as it is longer. Shocks are damped by
/// kick 5 rho h^2 (r- / V)^2 where the liquid is compressed (von Neumann, Richtmyer 1950).
///
/// With gas beta changes by a thousand within a shock. It is then a secant of the law, iterated (`follow_law`).
///
/// In the first step no pressure is known. The liquid is then in equilibrium with all that does not come at once: its pressure
/// before is what the pressure of an incompressible liquid is, and r = r-.
class Compression {
 public:
  /// `liquid`: empty, it is incompressible; `volume` around nodes [m^d], `density` at t = 0 [kg/m^3]; `carried`: by the nodes,
  /// empty: in the first step; `kick` and `dt` of the step [s].
  template <int d>
  void begin(std::function<LiquidState(double)> liquid, std::span<const double> volume, double density,
             std::vector<Compressed> carried, double kick, double dt);
  explicit operator bool() const { return !storage_.empty(); }           ///< the liquid is compressible
  bool starts() const { return !storage_.empty() && carried_.empty(); }  ///< nothing is known of its compression yet

  /// C added to the diagonal of other terms [m^d/(Pa s^2)]; `in_equilibrium`: of the first pressure, hardly anything.
  std::vector<double> diagonal(std::vector<double> others, bool in_equilibrium = false) const;
  /// Takes from a residual, of unknowns, what impulses of the repair leave on purpose [m^d/s]; `volume` [m^d]; `unknown`: of
  /// nodes, -1: none; `impulses`: of unknowns, empty: none yet [Pa s].
  void take_from(std::vector<double>& residual, std::span<const double> volume, std::span<const int> unknown,
                 std::span<const double> impulses) const;
  /// The repair has given these impulses: sets r-.
  void carry(std::span<const double> volume, std::span<const int> unknown, std::span<const double> impulses);
  /// r- / V of a node whose volume is not nothing [1/s].
  double rate(std::size_t i, double volume) const { return volume > 0 ? rate_before_[i] / volume : 0.0; }
  /// Sets the pressure by which a node's rate is damped, by what it exceeds its neighbours [1/s]; `size`: of elements [m].
  void damp(std::size_t i, double excess, double volume, double density, double size);
  /// What does not depend on phi, added to the sources of other terms [m^d/s].
  std::vector<double> source(std::vector<double> others) const;

  /// Takes for beta what has gone to nodes over what the law makes of their pressures then, half-way in its logarithm; false if
  /// the pressures of all are near enough to the law's already. Only gas needs it: without it a liquid is as good as linear.
  bool follow_law(std::span<const double> volume, std::span<const int> unknown, std::span<const double> impulses);
  /// What nodes carry on, of impulses of the pressure.
  std::vector<Compressed> after(std::span<const double> volume, std::span<const int> unknown,
                                std::span<const double> impulses) const;
  /// What of the work of these impulses is stored over the kick [J].
  double stored(std::span<const int> unknown, std::span<const double> impulses) const;
  /// Energy in it at t_n and t_{n+1}, by the law of the liquid [J]; both 0 in the first step.
  std::array<double, 2> internal_energies(std::span<const double> volume, std::span<const int> unknown,
                                          std::span<const double> impulses) const;
  /// Energy in it at t_n, of the mean pressure over the kick [J].
  double energy(std::span<const double> volume, std::span<const int> unknown, std::span<const double> impulses) const;

 private:
  using Weights = std::array<double, 4>;  ///< of the pressures at t_{n+1}, t_n, t_{n-1}, t_{n-2}
  static Weights weights(double elements_crossed);
  double constant(std::size_t i) const { return storage_[i] / (weights_[i][0] * kick_ * dt_); }
  double carried_impulse(std::size_t i) const;
  double pressure_after(double before, double left) const;
  double volume_left(double rate, double volume) const;
  double rate_after(std::size_t i, double impulse) const;

  std::function<LiquidState(double)> liquid_;
  std::vector<double> storage_, rate_before_, damping_;
  std::vector<Weights> weights_;
  std::vector<Compressed> carried_;
  double kick_ = 0, dt_ = 0;
};

}  // namespace splashdown::fluid
