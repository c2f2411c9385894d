#include "fluid/effects/waves/steady_wave.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fluid/effects/waves/dispersion.hpp"

namespace splashdown::fluid {
namespace {

using std::numbers::pi;

}  // namespace

double SteadyWave::length() const { return 2 * pi / wave_number_; }
double SteadyWave::period() const { return length() / celerity_; }
double SteadyWave::trough() const { return elevation(pi); }

void SteadyWave::set_depth(double depth) {
  depth_ = std::min(depth, deep_water / wave_number_);
  for (std::size_t j = 0; j < speed_.size(); ++j)
    speed_[j] /= 1 + std::exp(-2 * static_cast<double>(j + 1) * wave_number_ * depth_);
  highest_ = crest();
}

double SteadyWave::elevation(double theta) const {
  const double twice = 2 * std::cos(theta);
  double before = 1, now = 0.5 * twice, sum = 0;  // cos((j - 1) theta), cos(j theta)
  for (double e : elevation_) {
    sum += e * now;
    before = std::exchange(now, twice * now - before);
  }
  return sum;
}

SteadyWave::Speed SteadyWave::speed(double theta, double z) const {
  const double height = std::clamp(z, -depth_, highest_);
  const double rise = std::exp(wave_number_ * height), mirror = std::exp(-2 * wave_number_ * (height + depth_));
  const double c = std::cos(theta), s = std::sin(theta);
  double cosine = 1, sine = 0, up = 1, image = 1;
  Speed out{current_, 0};
  for (double b : speed_) {
    const double next = cosine * c - sine * s;
    sine = sine * c + cosine * s, cosine = next;
    up *= rise, image *= mirror;
    out.along += b * up * (1 + image) * cosine;
    out.up += b * up * (1 - image) * sine;
  }
  return out;
}

SteadyWave airy_wave(const SteadyWaveSpec& spec) {
  SteadyWave wave;
  const double g = spec.gravity, a = 0.5 * spec.height;
  // The current that closes the transport changes c, c the transport: a contraction for waves that do not break.
  double current = spec.transport, k = 2 * pi / spec.length;
  for (int pass = 0; pass < 50; ++pass) {
    if (spec.length == 0) k = wave_number(2 * pi / spec.period, spec.depth, g, current);
    const double own = angular_frequency(k, spec.depth, g) / k;
    current = spec.transport - 0.5 * g * a * a / (own * spec.depth);
    wave.celerity_ = own + current;
    wave.speed_ = {a * g / own};
  }
  wave.wave_number_ = k;
  wave.current_ = current;
  wave.elevation_ = {a};
  wave.set_depth(spec.depth);
  return wave;
}

}  // namespace splashdown::fluid
