#include "fluid/effects/waves/wavemaker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/effects/waves/dispersion.hpp"

namespace splashdown::fluid {

// Numerators and denominators times 2 exp(-2kd), so that nothing overflows.
double height_over_stroke(Paddle paddle, double kd, double hinge) {
  const double q = std::exp(-kd), e = q * q, below = 1 - e * e + 4 * kd * e;
  if (paddle == Paddle::piston) return 2 * (1 - e) * (1 - e) / below;
  const double fixed = kd * hinge, at_hinge = std::exp(fixed - kd) * (1 + std::exp(-2 * fixed));  // 2 q cosh kb
  const double moves = kd * (1 - hinge);
  return 2 * (1 - e) / moves * (moves * (1 - e) - (1 + e) + at_hinge) / below;
}

PaddleSea::PaddleSea(std::span<const SeaWave> waves, const PaddleSpec& spec) : ramp_(spec.ramp) {
  for (const auto& wave : waves) {
    const double w = wave.angular_frequency, k = wave_number(w, spec.depth, spec.gravity);
    const double ratio = height_over_stroke(spec.type, k * spec.depth, spec.hinge / spec.depth);
    waves_.push_back(
        {w, k, wave.phase, wave.amplitude, wave.amplitude / ratio, group_velocity(k, spec.depth, spec.gravity)});
  }
}

double PaddleSea::share(double t) const {
  const double s = ramp_ > 0 ? std::clamp(t / ramp_, 0., 1.) : t >= 0;
  return s * s * (3 - 2 * s);
}

double PaddleSea::displacement(double t) const {
  double sum = 0;
  for (const auto& c : waves_) sum += c.stroke * std::sin(c.w * t - c.phase);
  return share(t) * sum;
}

double PaddleSea::elevation(double x, double t) const {
  double sum = 0;
  for (const auto& c : waves_) sum += share(t - x / c.group) * c.amplitude * std::cos(c.w * t - c.k * x - c.phase);
  return sum;
}

double PaddleSea::shortest_period() const {
  return 2 * std::numbers::pi / std::ranges::max(waves_, {}, &Component::w).w;
}

}  // namespace splashdown::fluid
