// Waves in a free plate in plane strain by Rayleigh (1888) and Lamb (1917): of half the
// thickness h, with p^2 = w^2/cL^2 - k^2 and
// q^2 = w^2/cT^2 - k^2
//
//   S0   4 k^2 p sin(ph) cos(qh) + (q^2 - k^2)^2 cos(ph) sin(qh)/q = 0
//   A0   4 k^2 q sin(qh) cos(ph) + (q^2 - k^2)^2 cos(qh) sin(ph)/p = 0
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <stdexcept>

namespace splashdown::elastic {

/// Of a plate: speeds of waves of shear and compression [m/s], thickness [m].
struct Plate {
  double shear = 1, compression = 2, thickness = 1;
};

/// The left side of the equation at a frequency w [rad/s] and a phase velocity [m/s].
inline double rayleigh_lamb(const Plate& plate, bool symmetric, double w, double c) {
  using Complex = std::complex<double>;
  const double k = w / c, h = plate.thickness / 2;
  const Complex p = std::sqrt(Complex(std::pow(w / plate.compression, 2) - k * k)),
                q = std::sqrt(Complex(std::pow(w / plate.shear, 2) - k * k));
  const Complex a = symmetric ? p : q, b = symmetric ? q : p, square = std::pow(q * q - k * k, 2);
  return (4 * k * k * a * std::sin(a * h) * std::cos(b * h) + square * std::cos(a * h) * std::sin(b * h) / b).real();
}

/// Phase velocity of A0 (below the cut-off of A1, w h = pi cT/2) or S0 (below that of S1), the only root between a tenth of
/// Rayleigh's and a little above the plate's speed.
inline double phase_velocity(const Plate& plate, bool symmetric, double w) {
  const auto left = [&](double c) { return rayleigh_lamb(plate, symmetric, w, c); };
  const double cT = plate.shear, plates = 2 * cT * std::sqrt(1 - std::pow(cT / plate.compression, 2));
  constexpr int steps = 400;
  const double low = symmetric ? 0.9 * cT : 0.02 * cT, high = symmetric ? 1.001 * plates : 0.99 * cT;
  for (int n = 0; n < steps; ++n) {
    double from = low + (high - low) * n / steps, to = low + (high - low) * (n + 1) / steps;
    if (!(left(from) * left(to) < 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (from + to);
      (left(from) * left(middle) <= 0 ? to : from) = middle;
    }
    return from;
  }
  throw std::runtime_error("no such wave");
}

/// dw/dk.
inline double group_velocity(const Plate& plate, bool symmetric, double w) {
  const auto k = [&](double at) { return at / phase_velocity(plate, symmetric, at); };
  const double step = 1e-4 * w;
  return 2 * step / (k(w + step) - k(w - step));
}

}  // namespace splashdown::elastic
