#include "fluid/effects/waves/dispersion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace splashdown::fluid {

double angular_frequency(double wave_number, double depth, double gravity) {
  return std::sqrt(gravity * wave_number * std::tanh(wave_number * depth));
}

double wave_number(double angular_frequency_seen, double depth, double gravity, double current) {
  const double w = angular_frequency_seen;
  // w - k U - sqrt(g k tanh(k d)): falls with k but for a current from ahead, where it has a minimum that has to be below zero.
  const auto excess = [&](double k) { return w - k * current - angular_frequency(k, depth, gravity); };
  double low = 0, high = w * w / gravity + w / std::sqrt(gravity * std::min(depth, gravity / (w * w)));
  if (current < 0) {
    const auto slope = [&](double k) { return -current - group_velocity(k, depth, gravity); };
    while (slope(high) < 0) high *= 2;
    for (double from = high, to = 0; from - to > 1e-15 * from;) {  // to where group velocity and current balance
      const double k = 0.5 * (from + to);
      if (k == from || k == to) break;
      (slope(k) > 0 ? from : to) = k, high = k;
    }
    if (excess(high) > 0) throw std::invalid_argument("the current stops waves of this period");
  }
  while (excess(high) > 0) high *= 2;
  for (;;) {
    const double k = 0.5 * (low + high);
    if (k == low || k == high) return k;
    (excess(k) > 0 ? low : high) = k;
  }
}

double group_velocity(double wave_number, double depth, double gravity) {
  const double kd = wave_number * depth, w = angular_frequency(wave_number, depth, gravity);
  constexpr double deep = 300;  // sinh is finite below
  const double share = kd > deep ? 0.0 : 2 * kd / std::sinh(2 * kd);
  return 0.5 * w / wave_number * (1 + share);
}

double breaking_height(double length, double depth) {
  return 0.142 * length * std::tanh(2 * std::numbers::pi / length * depth);
}

}  // namespace splashdown::fluid
