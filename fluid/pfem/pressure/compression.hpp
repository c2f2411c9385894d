// How a liquid gives way to pressure. With beta = V / (rho c^2) of the water around a node, its pressure P and the volume r
// that goes there per time, both at t_{n-1/2} (-) and t_{n+1/2} (+),
//
//   beta (P+ - P-) = kick (r- + r+) / 2,   phi = kick (P- + P+) / 2
//
// is the trapezoidal rule, of second order, and keeps kinetic energy + sum beta P^2 / 2 to roundoff. Eliminated, it is a
// diagonal and a source of the pressure equation:
//
//   r+ = C phi - q,   C = 4 beta / kick^2,   q = C kick P- + r-
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Of one step; entries are of nodes unless said.
///
/// The repair makes the carried velocity compress the water as it did on the old mesh, r- = d V with the rate d that nodes
/// carry, and gives way with the same C, r- = d V + C Phi, so that what meets a wall at once is stopped by sound, or at once
/// where the step is long for sound.
///
/// Waves of few elements, which no mesh carries well, are damped by a bulk viscosity zeta = 0.2 rho c h on what the rate differs
/// from its mean over the cells around, explicitly:
///
///   phi = kick ((P- + P+) / 2 + zeta (r- / V - mean))
///
/// of third order on a wave that elements resolve; where the step is longer than h / 2 c, by as much less as it is longer.
///
/// In the first step no P- is known. The liquid is then in equilibrium with all that does not come at once: P- is what the
/// pressure of an incompressible liquid is, and r+ = r-.
class Compression {
 public:
  /// `storage`: beta [m^d/Pa], empty: the liquid is incompressible; `carried`: by the nodes, empty: in the first step; `kick`
  /// [s].
  void begin(std::vector<double> storage, std::vector<Compressed> carried, double kick);
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
  /// q added to the sources of other terms [m^d/s].
  std::vector<double> source(std::vector<double> others) const;

  /// What nodes carry on, of impulses of the pressure.
  std::vector<Compressed> after(std::span<const double> volume, std::span<const int> unknown,
                                std::span<const double> impulses) const;
  /// What of the work of these impulses is stored over the kick [J].
  double stored(std::span<const int> unknown, std::span<const double> impulses) const;
  /// Energy in it at t_n, of the mean pressure over the kick [J].
  double energy(std::span<const int> unknown, std::span<const double> impulses) const;

 private:
  double constant(std::size_t i) const { return 4 * storage_[i] / (kick_ * kick_); }
  double rate_after(std::size_t i, double impulse) const;

  std::vector<double> storage_, rate_before_, damping_;
  std::vector<Compressed> carried_;
  double kick_ = 0;
};

}  // namespace splashdown::fluid
