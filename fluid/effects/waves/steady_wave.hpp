// Waves of permanent form on water of constant depth d, by Fourier series in the frame that moves along (Rienecker, Fenton,
// J. Fluid Mech. 104, 1981; Fenton, Computers and Geosciences 14, 1988):
//
//   psi = - u_m (d + z) + sum_j b_j / (j k) sinh(j k (d + z)) / cosh(j k d) cos(j theta),   theta = k (x - c t)
//   psi = const,   |grad psi|^2 / 2 + g z = const   on z = eta(theta)
//
// in as many points as there are unknowns, by Newton's method from small heights up. Exact to roundoff for waves that do not come
// close to breaking; z and eta from the still level, where the mean of eta is. Depths may be infinite.
#pragma once

#include <vector>

namespace splashdown::fluid {

/// A wave and what fixes it.
struct SteadyWaveSpec {
  double height = 0;      ///< crest above trough [m]
  double period = 0;      ///< as a fixed observer sees it [s]; 0: the length is given
  double length = 0;      ///< [m]; 0: the period is given
  double depth = 0;       ///< of still water [m]
  double gravity = 9.81;  ///< [m/s^2]
  double transport = 0;   ///< mean speed of the water through a vertical section [m/s]; closed tanks have none
};

/// A solved wave.
class SteadyWave {
 public:
  double length() const;                                ///< [m]
  double period() const;                                ///< as a fixed observer sees it [s]
  double celerity() const { return celerity_; }         ///< c [m/s]
  double wave_number() const { return wave_number_; }   ///< k [1/m]
  double current() const { return current_; }           ///< c_E, mean speed at a place that is always wet [m/s]
  double crest() const { return elevation(0); }         ///< [m]
  double trough() const;                                ///< [m], negative
  double height() const { return crest() - trough(); }  ///< [m]
  /// How much one more term would still change the surface, over the height: what the series leaves out.
  double tail() const { return tail_; }

  /// Above the still level [m] at the phase theta = k (x - c t); a crest is at 0.
  double elevation(double theta) const;
  /// Along the wave and upward [m/s] at `z` above the still level. Above the crest as at its height.
  struct Speed {
    double along, up;
  };
  /// Of the water at a phase [rad] and a height above the still level [m].
  Speed speed(double theta, double z) const;

 private:
  friend class StreamFunction;
  friend SteadyWave airy_wave(const SteadyWaveSpec& spec);
  void set_depth(double depth);
  double wave_number_ = 0, celerity_ = 0, current_ = 0, depth_ = 0, tail_ = 0, highest_ = 0;
  std::vector<double> elevation_;  // of cos(j theta), j = 1 ...
  std::vector<double> speed_;      // b_j / (1 + exp(- 2 j k d)), j = 1 ...
};

/// std::invalid_argument where there is no such wave: height above `breaking_height`, or no convergence.
SteadyWave stream_function_wave(const SteadyWaveSpec& spec);

/// Of the first order in the height, with the current that the second order's transport, g H^2 / (8 c), asks for.
SteadyWave airy_wave(const SteadyWaveSpec& spec);

}  // namespace splashdown::fluid
