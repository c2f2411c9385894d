// Linear waves of small steepness on water of constant depth d (Airy 1845):
//
//   (w - k U)^2 = g k tanh(k d)
//
// w the angular frequency that a fixed observer sees, k the wave number, U a current along the wave. Depths may be infinite.
#pragma once

namespace splashdown::fluid {

/// k d from which on the bed is not felt: exp(-2 k d) = exp(-60).
inline constexpr double deep_water = 30;

/// w [rad/s] of the wave number k [1/m] without a current, at `depth` [m] under `gravity` [m/s^2].
double angular_frequency(double wave_number, double depth, double gravity);

/// k [1/m] to roundoff, w [rad/s] as a fixed observer sees it over `current` [m/s]. std::invalid_argument where waves cannot run
/// against the current.
double wave_number(double angular_frequency, double depth, double gravity, double current = 0);

/// dw/dk [m/s], without a current: the speed of the energy.
double group_velocity(double wave_number, double depth, double gravity);

/// Waves of this length [m] break above 0.142 length tanh(k depth) [m] (Miche, Ann. Ponts Chaussees 114, 1944).
double breaking_height(double length, double depth);

}  // namespace splashdown::fluid
