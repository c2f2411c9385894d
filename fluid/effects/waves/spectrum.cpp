#include "fluid/effects/waves/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace splashdown::fluid {
namespace {

using std::numbers::pi;

// Over w / w_p.
double shape(double relative, double gamma) {
  if (relative <= 0) return 0;
  const double width = relative < 1 ? 0.07 : 0.09, off = (relative - 1) / width;
  return std::pow(relative, -5) * std::exp(-1.25 * std::pow(relative, -4)) *
         std::pow(gamma, std::exp(-0.5 * off * off));
}

// Simpson's rule.
template <class Function>
double integral(const Function& f, double from, double to, int pieces) {
  const double h = (to - from) / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const double x = from + i * h;
    sum += h / 6 * (f(x) + 4 * f(x + 0.5 * h) + f(x + h));
  }
  return sum;
}

// Distributions of the standard library differ from one library to the next, its generators do not.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 bits_;
};

// The angle below which the share `below` of cos^2s(angle / 2) lies.
class Spreading {
 public:
  explicit Spreading(double s) : share_(cells + 1, 0.0) {
    const auto density = [&](double angle) { return std::pow(std::cos(0.5 * angle), 2 * s); };
    for (int i = 0; i < cells; ++i) share_[i + 1] = share_[i] + integral(density, angle_at(i), angle_at(i + 1), 1);
  }
  double operator()(double below) const {
    const double target = below * share_.back();
    const auto after = std::upper_bound(share_.begin() + 1, share_.end() - 1, target);
    const auto i = static_cast<int>(after - share_.begin());
    return angle_at(i - 1) + (target - share_[i - 1]) / (share_[i] - share_[i - 1]) * (angle_at(i) - angle_at(i - 1));
  }

 private:
  static constexpr int cells = 720;
  static double angle_at(int i) { return pi * (2.0 * i / cells - 1); }
  std::vector<double> share_;
};

// Energies of the frequencies, without scale, and the waves without phases.
std::vector<SeaWave> frequencies(const SpectrumSpec& spec, std::vector<double>& energy) {
  const double spacing = 1.0 / spec.repeat, peak = 2 * pi / spec.peak_period;
  const auto density = [&](double relative) { return shape(relative, spec.gamma); };
  std::vector<SeaWave> out;
  const int first = static_cast<int>(std::lround(spec.lowest * spec.repeat)),
            last = static_cast<int>(std::lround(spec.highest * spec.repeat));
  for (int j = std::max(1, first); j <= last; ++j) {
    const double at = j * spacing;
    energy.push_back(integral(density, at - 0.5 * spacing, at + 0.5 * spacing, 4));
    out.push_back({0, at * peak, 0, 0});
  }
  return out;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum;
}

}  // namespace

double spectral_density(double angular_frequency, double peak_period, double gamma) {
  constexpr double widest = 20;  // w_p: 1e-5 of the energy is above
  const double peak = 2 * pi / peak_period;
  const auto density = [&](double relative) { return shape(relative, gamma); };
  const double all = integral(density, 0, 2, 200) + integral(density, 2, widest, 100) + 0.25 * std::pow(widest, -4);
  return density(angular_frequency / peak) / (all * peak);
}

std::vector<SeaWave> sea_waves(const SpectrumSpec& spec) {
  std::vector<double> energy;
  auto waves = frequencies(spec, energy);
  const double scale = std::pow(0.25 * spec.significant_height, 2) / sum_of(energy);
  Uniform uniform(spec.seed);
  const Spreading spread(std::max(spec.spreading, 1e-3));
  for (std::size_t j = 0; j < waves.size(); ++j) {
    waves[j].amplitude = std::sqrt(2 * scale * energy[j]);
    waves[j].phase = 2 * pi * uniform();
    const double drawn = uniform();  // with or without a use: spreading leaves the phases as they are
    if (spec.spreading > 0) waves[j].direction = spread(drawn);
  }
  return waves;
}

std::vector<SeaWave> focused_waves(const SpectrumSpec& spec, double crest) {
  std::vector<double> energy;
  auto waves = frequencies(spec, energy);
  const double all = sum_of(energy);
  for (std::size_t j = 0; j < waves.size(); ++j) waves[j].amplitude = crest * energy[j] / all;
  return waves;
}

}  // namespace splashdown::fluid
