#include "fluid/effects/compressibility/compressibility.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::fluid {
namespace {

/// Volume over that at rest, - d ln(volume)/dp [1/Pa] and the work that made it so over the volume at rest [Pa].
struct Squeezed {
  double volume, compliance, energy;
};

Squeezed liquid(double K, double slope, double p) {
  // Tension softens the liquid, to half of K at most.
  p = std::max(p, slope > 0 ? -K / (2 * slope) : -0.5 * K);
  const double x = p / K;
  const bool constant = slope < 1e-9;
  const double volume = constant ? std::exp(-x) : std::pow(1 + slope * x, -1 / slope);
  // Exact differences would be of rounding alone: int x' dV of the first two terms of the series.
  constexpr double small = 1e-4;
  double energy = 0.5 * x * x - (1 + slope) * x * x * x / 3;
  if (std::abs(x) > small && constant) energy = 1 - volume * (1 + x);
  if (std::abs(x) > small && !constant) {
    const double y = 1 + slope * x;
    const auto primitive = [&](double at) {
      const double logarithmic =
          std::abs(slope - 1) < 1e-9 ? std::log(at) : std::pow(at, 1 - 1 / slope) / (1 - 1 / slope);
      return logarithmic + slope * std::pow(at, -1 / slope);
    };
    energy = (primitive(y) - primitive(1)) / (slope * slope);
  }
  return {volume, 1 / (K + slope * p), K * energy};
}

Squeezed gas(double ambient, double gamma, double p) {
  constexpr double thinnest = 1e-2;
  const double above = std::max(thinnest, 1 + p / ambient), volume = std::pow(above, -1 / gamma);
  return {volume, 1 / (gamma * ambient * above),
          ambient * ((above * volume - 1) / (gamma - 1) - (1 - volume))};  // adiabatic, less what the air around does
}

}  // namespace

LiquidState liquid_state(const CompressibilitySpec& spec, double pressure) {
  const auto l = liquid(spec.bulk_modulus, spec.bulk_modulus_slope, pressure);
  const auto g = gas(spec.ambient_pressure, spec.adiabatic_exponent, pressure);
  const double a = spec.gas_content, volume = (1 - a) * l.volume + a * g.volume;
  return {.density = 1 / volume,
          .compliance = ((1 - a) * l.volume * l.compliance + a * g.volume * g.compliance) / volume,
          .energy = (1 - a) * l.energy + a * g.energy};
}

template <int d>
void Compressibility<d>::pressure(const StepView<d>&, PressureTerms& terms) {
  terms.liquid = [this](double pressure) { return liquid_state(spec_, pressure); };
}

template class Compressibility<2>;
template class Compressibility<3>;

}  // namespace splashdown::fluid
