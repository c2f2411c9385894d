#include "fluid/effects/waves/wave_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/effects/waves/dispersion.hpp"

namespace splashdown::fluid {
namespace {

using std::numbers::pi;

double from_crest(double theta) {
  const double turns = -theta / (2 * pi);
  return 2 * pi * (turns - std::floor(turns));
}

// Turned from the sea's direction by an angle.
template <int d>
Vec<d> turned(const Vec<d>& direction, double angle) {
  if constexpr (d == 2) return direction;
  Vec<d> out = direction;
  out[0] = std::cos(angle) * direction[0] - std::sin(angle) * direction[1];
  out[1] = std::sin(angle) * direction[0] + std::cos(angle) * direction[1];
  return out;
}

}  // namespace

template <int d>
double RegularWave<d>::theta(const Vec<d>& x, double t) const {
  return wave_.wave_number() * (frame_.along(x) - wave_.celerity() * (t - frame_.time));
}

template <int d>
double RegularWave<d>::elevation(const Vec<d>& x, double t) const {
  return wave_.elevation(theta(x, t));
}

template <int d>
Vec<d> RegularWave<d>::velocity(const Vec<d>& x, double t) const {
  const auto [along, up] = wave_.speed(theta(x, t), x[d - 1] - frame_.level());
  return along * frame_.direction + up * Vec<d>::Unit(d - 1);
}

template <int d>
double RegularWave<d>::phase(const Vec<d>& x, double t) const {
  return from_crest(theta(x, t));
}

template <int d>
LinearSea<d>::LinearSea(const std::vector<SeaWave>& waves, const SeaFrame<d>& frame, double peak_period, double current,
                        double highest)
    : frame_(frame), highest_(highest) {
  const double peak = wave_number(2 * pi / peak_period, frame.depth, frame.gravity, current);
  length_ = 2 * pi / peak;
  period_ = 2 * pi / angular_frequency(peak, frame.depth, frame.gravity);
  for (const SeaWave& wave : waves) {
    const double k =
        wave_number(wave.angular_frequency, frame.depth, frame.gravity, current * std::cos(wave.direction));
    const double w = angular_frequency(k, frame.depth, frame.gravity);
    const Vec<d> along = turned<d>(frame.direction, wave.direction);
    waves_.push_back({along, k, w, wave.phase, wave.amplitude, wave.amplitude * w / -std::expm1(-2 * k * frame.depth)});
    current_ -= 0.5 * frame.gravity * wave.amplitude * wave.amplitude * k / (w * frame.depth) * along;
  }
  std::ranges::sort(waves_, {}, &Component::k);
}

template <int d>
double LinearSea<d>::angle(const Component& c, const Vec<d>& from_origin, double t) const {
  return c.k * c.along.dot(from_origin) - c.w * (t - frame_.time) + c.phase;
}

template <int d>
double LinearSea<d>::elevation(const Vec<d>& x, double t) const {
  const Vec<d> from_origin = x - frame_.origin;
  double sum = 0;
  for (const Component& c : waves_) sum += c.amplitude * std::cos(angle(c, from_origin, t));
  return sum;
}

template <int d>
Vec<d> LinearSea<d>::velocity(const Vec<d>& x, double t) const {
  constexpr double nothing = 20;  // exp(-20): of waves that do not reach down here
  const Vec<d> from_origin = x - frame_.origin;
  const double z = std::clamp(from_origin[d - 1], -frame_.depth, 0.0);
  Vec<d> v = current_;
  for (const Component& c : waves_) {
    if (-c.k * z > nothing) break;
    const double theta = angle(c, from_origin, t), decay = c.speed * std::exp(c.k * z),
                 image = std::exp(-2 * c.k * (z + frame_.depth));
    v += decay * (1 + image) * std::cos(theta) * c.along;
    v[d - 1] += decay * (1 - image) * std::sin(theta);
  }
  return v;
}

template <int d>
double LinearSea<d>::shortest() const {
  return 2 * pi / waves_.back().k;
}

template <int d>
double LinearSea<d>::phase(const Vec<d>& x, double t) const {
  return from_crest(2 * pi * (frame_.along(x) / length_ - (t - frame_.time) / period_));
}

template class RegularWave<2>;
template class RegularWave<3>;
template class LinearSea<2>;
template class LinearSea<3>;

}  // namespace splashdown::fluid
