#include "fluid/pfem/pressure/compression.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::fluid {
namespace {

// Of C: what a first pressure in equilibrium has of it. It keeps enclosed liquid regular.
constexpr double hardly_any = 1e-6;

double at(std::span<const int> unknown, std::span<const double> impulses, std::size_t node) {
  return unknown[node] < 0 || impulses.empty() ? 0.0 : impulses[unknown[node]];
}

}  // namespace

void Compression::begin(std::vector<double> storage, std::vector<Compressed> carried, double kick) {
  storage_ = std::move(storage);
  carried_ = std::move(carried);
  kick_ = kick;
  rate_before_.assign(storage_.size(), 0.0);
  damping_.assign(storage_.size(), 0.0);
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
    others[i] +=
        starts() ? -rate_before_[i] : constant(i) * kick_ * (carried_[i].pressure + damping_[i]) + rate_before_[i];
  return others;
}

double Compression::rate_after(std::size_t i, double impulse) const {
  if (starts()) return hardly_any * constant(i) * impulse + rate_before_[i];
  return constant(i) * (impulse - kick_ * (carried_[i].pressure + damping_[i])) - rate_before_[i];
}

std::vector<Compressed> Compression::after(std::span<const double> volume, std::span<const int> unknown,
                                           std::span<const double> impulses) const {
  std::vector<Compressed> out(storage_.size());
  for (std::size_t i = 0; i < storage_.size(); ++i) {
    if (unknown[i] < 0 || !(storage_[i] > 0) || !(volume[i] > 0)) continue;
    const double impulse = at(unknown, impulses, i), rate = rate_after(i, impulse);
    const double before = starts() ? impulse / kick_ : carried_[i].pressure;
    out[i] = {before + 0.5 * kick_ / storage_[i] * (rate_before_[i] + rate), rate / volume[i]};
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
