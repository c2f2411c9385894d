#include "fluid/pfem/pressure/compression.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splashdown::fluid {
namespace {

// Of C: what a first pressure in equilibrium has of it. It keeps enclosed liquid regular.
constexpr double hardly_any = 1e-6;

double at(std::span<const int> unknown, std::span<const double> impulses, std::size_t node) {
  return unknown[node] < 0 || impulses.empty() ? 0.0 : impulses[unknown[node]];
}

}  // namespace

template <int d>
void Compression::begin(std::function<LiquidState(double)> liquid, std::span<const double> volume, double density,
                        std::vector<Compressed> carried, double kick, double dt) {
  liquid_ = std::move(liquid);
  carried_ = std::move(carried);
  kick_ = kick, dt_ = dt;
  storage_.clear(), weights_.clear();
  if (!liquid_) return;
  rate_before_.assign(volume.size(), 0.0);
  damping_.assign(volume.size(), 0.0);
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const auto state = liquid_(carried_.empty() ? 0.0 : carried_[i].pressure[0]);
    storage_.push_back(std::max(0.0, volume[i]) * state.compliance);
    const double sound = 1 / std::sqrt(density * state.density * state.compliance);
    weights_.push_back(weights(volume[i] > 0 ? sound * kick / std::pow(volume[i], 1.0 / d) : 0.0));
  }
}
template void Compression::begin<2>(std::function<LiquidState(double)>, std::span<const double>, double,
                                    std::vector<Compressed>, double, double);
template void Compression::begin<3>(std::function<LiquidState(double)>, std::span<const double>, double,
                                    std::vector<Compressed>, double, double);

Compression::Weights Compression::weights(double elements_crossed) {
  constexpr double kept = 0.95, least = 0.5, resolved = 2;
  const double q = least + (kept - least) * std::min(1.0, resolved / std::max(elements_crossed, resolved)),
               s = (1 - q) / (2 * q), sum = (1 + q) * (1 + q) * (1 + s);
  return {1 / sum, (2 * q + s) / sum, (q * q + 2 * q * s) / sum, q * q * s / sum};
}

std::vector<double> Compression::diagonal(std::vector<double> others, bool in_equilibrium) const {
  if (storage_.empty()) return others;
  others.resize(storage_.size(), 0.0);
  for (std::size_t i = 0; i < storage_.size(); ++i) others[i] += (in_equilibrium ? hardly_any : 1.0) * constant(i);
  return others;
}

void Compression::take_from(std::vector<double>& residual, std::span<const double> volume, std::span<const int> unknown,
                            std::span<const double> impulses) const {
  for (std::size_t i = 0; i < storage_.size(); ++i)
    if (unknown[i] >= 0)
      residual[unknown[i]] -= (starts() ? 0.0 : carried_[i].rate * volume[i]) + constant(i) * at(unknown, impulses, i);
}

void Compression::carry(std::span<const double> volume, std::span<const int> unknown,
                        std::span<const double> impulses) {
  for (std::size_t i = 0; i < storage_.size(); ++i)
    rate_before_[i] = (starts() ? 0.0 : carried_[i].rate * volume[i]) + constant(i) * at(unknown, impulses, i);
}

// Explicit: viscosity times kick over size squared stays below a third.
void Compression::damp(std::size_t i, double excess, double volume, double density, double size) {
  constexpr double share = 0.2, resolved = 0.5;  // of c h; of h / c
  constexpr double squared = 5, strain = 0.05;   // of h^2 times the rate; in a kick
  if (starts() || !(storage_[i] > 0) || !(volume > 0)) return;
  const double c = std::sqrt(volume / (storage_[i] * density)), rate = std::max(0.0, rate_before_[i] / volume);
  const double linear = share * c * std::min(1.0, resolved * size / (c * kick_)) * excess,
               quadratic = squared * size * rate * std::min(rate, strain / kick_);
  damping_[i] = density * size * (linear + quadratic);
}

std::vector<double> Compression::source(std::vector<double> others) const {
  if (storage_.empty()) return others;
  others.resize(storage_.size(), 0.0);
  for (std::size_t i = 0; i < storage_.size(); ++i)
    others[i] += starts() ? -rate_before_[i] : constant(i) * carried_impulse(i);
  return others;
}

// What phi is if nothing more goes to the node.
double Compression::carried_impulse(std::size_t i) const {
  const auto& before = carried_[i].pressure;
  const auto& w = weights_[i];
  return kick_ * ((w[0] + w[1]) * before[0] + w[2] * before[1] + w[3] * before[2] + damping_[i]);
}

double Compression::rate_after(std::size_t i, double impulse) const {
  if (starts()) return hardly_any * constant(i) * impulse + rate_before_[i];
  return constant(i) * (impulse - carried_impulse(i));
}

// Of liquid of which a share of the volume is left. Newton's method on ln(density), which is concave: from the first step on it
// comes from below.
double Compression::pressure_after(double before, double left) const {
  constexpr int most = 50;
  constexpr double close = 1e-14;
  const double density = liquid_(before).density / left;
  double p = before;
  for (int k = 0; k < most; ++k) {
    const auto state = liquid_(p);
    const double off = std::log(density / state.density);
    p += off / state.compliance;
    if (std::abs(off) < close) break;
  }
  return p;
}

// Mass stays: what has gone there is out of its volume, or of most of it.
double Compression::volume_left(double rate, double volume) const {
  constexpr double least_left = 0.2;
  return std::max(least_left, 1 - dt_ * rate / volume);
}

bool Compression::follow_law(std::span<const double> volume, std::span<const int> unknown,
                             std::span<const double> impulses) {
  if (!*this || starts()) return false;
  constexpr double near = 0.02, strained = 1e-4;
  double highest = 0, farthest = 0;
  std::vector<double> secant(storage_);
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    if (unknown[i] < 0 || !(storage_[i] > 0)) continue;
    const double gone = dt_ * rate_after(i, at(unknown, impulses, i)), before = carried_[i].pressure[0];
    const double linear = before + gone / storage_[i];
    highest = std::max(highest, std::abs(linear));
    if (std::abs(gone) < strained * volume[i]) continue;
    const double law = pressure_after(before, volume_left(gone / dt_, volume[i]));
    farthest = std::max(farthest, std::abs(law - linear));
    secant[i] = std::sqrt(storage_[i] * std::abs(gone / (law - before)));
  }
  if (farthest <= near * highest) return false;
  storage_ = std::move(secant);
  return true;
}

std::vector<Compressed> Compression::after(std::span<const double> volume, std::span<const int> unknown,
                                           std::span<const double> impulses) const {
  std::vector<Compressed> out(storage_.size());
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    if (unknown[i] < 0 || !(storage_[i] > 0) || !(volume[i] > 0)) continue;
    const double impulse = at(unknown, impulses, i), rate = rate_after(i, impulse);
    const double first = impulse / kick_;
    const auto before = starts() ? std::array{first, first, first} : carried_[i].pressure;
    const double left = volume_left(rate, volume[i]);
    out[i] = {{pressure_after(before[0], left), before[0], before[1]},
              rate / volume[i],
              (starts() ? 1.0 : carried_[i].density) / left};
  }
  return out;
}

double Compression::stored(std::span<const int> unknown, std::span<const double> impulses) const {
  double sum = 0;
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    const double impulse = at(unknown, impulses, i);
    sum += 0.5 * impulse * (rate_before_[i] + rate_after(i, impulse));
  }
  return sum;
}

std::array<double, 2> Compression::internal_energies(std::span<const double> volume, std::span<const int> unknown,
                                                     std::span<const double> impulses) const {
  std::array<double, 2> sum{};
  if (starts()) return sum;
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    if (unknown[i] < 0 || !(volume[i] > 0)) continue;
    const auto before = liquid_(carried_[i].pressure[0]);
    const double left = volume_left(rate_after(i, at(unknown, impulses, i)), volume[i]);
    const double at_rest = volume[i] * before.density;
    sum[0] += at_rest * before.energy;
    sum[1] += at_rest * liquid_(pressure_after(carried_[i].pressure[0], left)).energy;
  }
  return sum;
}

double Compression::energy(std::span<const double> volume, std::span<const int> unknown,
                           std::span<const double> impulses) const {
  double sum = 0;
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    const auto state = liquid_(at(unknown, impulses, i) / kick_);
    sum += state.energy * state.density * std::max(0.0, volume[i]);
  }
  return sum;
}

}  // namespace splashdown::fluid
