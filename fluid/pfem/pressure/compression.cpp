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
void Compression::begin(std::vector<double> storage, std::span<const double> volume, double density,
                        std::vector<Compressed> carried, double kick, double dt) {
  storage_ = std::move(storage);
  carried_ = std::move(carried);
  kick_ = kick, dt_ = dt;
  rate_before_.assign(storage_.size(), 0.0);
  damping_.assign(storage_.size(), 0.0);
  weights_.resize(storage_.size());
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    const bool carries = storage_[i] > 0 && volume[i] > 0;
    const double sound = carries ? std::sqrt(volume[i] / (storage_[i] * density)) : 0.0;
    weights_[i] = weights(carries ? sound * kick / std::pow(volume[i], 1.0 / d) : 0.0);
  }
}
template void Compression::begin<2>(std::vector<double>, std::span<const double>, double, std::vector<Compressed>,
                                    double, double);
template void Compression::begin<3>(std::vector<double>, std::span<const double>, double, std::vector<Compressed>,
                                    double, double);

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

void Compression::damp(std::size_t i, double excess, double volume, double density, double size) {
  constexpr double share = 0.2, resolved = 0.5;  // of rho c h; of h / c
  if (starts() || !(storage_[i] > 0) || !(volume > 0)) return;
  const double c = std::sqrt(volume / (storage_[i] * density));
  damping_[i] = share * density * c * size * std::min(1.0, resolved * size / (c * kick_)) * excess;
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

std::vector<Compressed> Compression::after(std::span<const double> volume, std::span<const int> unknown,
                                           std::span<const double> impulses) const {
  std::vector<Compressed> out(storage_.size());
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    if (unknown[i] < 0 || !(storage_[i] > 0) || !(volume[i] > 0)) continue;
    const double impulse = at(unknown, impulses, i), rate = rate_after(i, impulse);
    const double first = impulse / kick_;
    const auto before = starts() ? std::array{first, first, first} : carried_[i].pressure;
    out[i] = {{before[0] + dt_ / storage_[i] * rate, before[0], before[1]}, rate / volume[i]};
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

double Compression::energy(std::span<const int> unknown, std::span<const double> impulses) const {
  double sum = 0;
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    const double mean = at(unknown, impulses, i) / kick_;
    sum += 0.5 * storage_[i] * mean * mean;
  }
  return sum;
}

}  // namespace splashdown::fluid
