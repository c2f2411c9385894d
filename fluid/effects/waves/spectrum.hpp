// Energy of a sea over its frequencies, as a sum of linear waves:
//
//   S(w) ~ w^-5 exp(-5/4 (w_p / w)^4) gamma^r,   r = exp(-(w / w_p - 1)^2 / (2 s^2)),   s = 0.07 below w_p, 0.09 above
//
// gamma = 1: Pierson, Moskowitz, J. Geophys. Res. 69 (1964); 3.3 in the mean of JONSWAP, Hasselmann et al. (1973). Directions are
// distributed as cos^2s of half the angle to the mean one (Longuet-Higgins, Cartwright, Smith 1963), one for each frequency: two
// of one frequency would make a pattern that stands (Jefferys, Appl. Ocean Res. 9, 1987).
#pragma once

#include <cstdint>
#include <vector>

namespace splashdown::fluid {

/// A sea, and how finely it is taken apart. It repeats itself after `repeat` peak periods.
struct SpectrumSpec {
  double significant_height = 0;  ///< H_s, four standard deviations of the surface [m]
  double peak_period = 0;         ///< T_p [s]
  double gamma = 3.3;             ///< peak enhancement
  double spreading = 0;           ///< s; 0: all waves run one way
  std::uint64_t seed = 1;         ///< of phases and directions
  int repeat = 100;               ///< peak periods
  double lowest = 0.6;            ///< frequency, over that of the peak: less than 1e-3 of the energy is below
  double highest = 3.0;           ///< and above it 1.5 % for gamma = 1
};

/// One wave of a sea.
struct SeaWave {
  double amplitude;          ///< [m]
  double angular_frequency;  ///< [rad/s]
  double direction;          ///< angle to the mean one [rad]
  double phase;              ///< at t = 0 and the origin, from a crest on [rad]
};

/// S(w), over the integral of all w [s].
double spectral_density(double angular_frequency, double peak_period, double gamma);

/// The sea's waves, of equal distance in frequency and together of H_s exactly. The same seed gives the same waves everywhere.
std::vector<SeaWave> sea_waves(const SpectrumSpec& spec);

/// The mean shape of a sea around a crest of `crest` [m] at the origin and t = 0: amplitudes go as S(w), all phases are zero
/// (Tromans, Anaturk, Hagemeijer, ISOPE 1991: NewWave). One direction; the significant height does not matter.
std::vector<SeaWave> focused_waves(const SpectrumSpec& spec, double crest);

}  // namespace splashdown::fluid
