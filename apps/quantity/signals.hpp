// Signals in time: how late a tone comes, how late its packet, when it arrives.
//
// With Y(f) = int y exp(-2 pi i f x) dx over the rows, by the trapezoidal rule. x increases; else std::runtime_error.
#pragma once

#include <vector>

namespace splashdown::quantity {

/// Phase by which the tone f of a signal comes late, -arg Y(f), from 0 to 2 pi [rad]: 2 pi f x0 of cos(2 pi f (x - x0)).
double lag(const std::vector<double>& y, const std::vector<double>& x, double frequency);

/// Group delay at f, -d arg Y/d(2 pi f) = Re(int x y exp(-2 pi i f x) dx / Y(f)): when the packet around f passes.
double delay(const std::vector<double>& y, const std::vector<double>& x, double frequency);

/// |y + i H(y)| with Hilbert's transform H, by Fourier's transform of the signal on even steps, padded with zeros.
std::vector<double> envelope(const std::vector<double>& y, const std::vector<double>& x);

/// x where the envelope first reaches half of its largest value; linear between rows.
double arrival(const std::vector<double>& y, const std::vector<double>& x);

}  // namespace splashdown::quantity
