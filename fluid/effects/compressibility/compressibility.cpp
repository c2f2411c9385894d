#include "fluid/effects/compressibility/compressibility.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::fluid {

double volume_per_pascal(const CompressibilitySpec& spec, double volume, double pressure) {
  // Tension does not make more of the gas than this.
  constexpr double thinnest = 1e-2;
  const double above = std::max(thinnest, 1 + pressure / spec.ambient_pressure);
  const double gas = spec.gas_content * std::pow(above, -1 / spec.adiabatic_exponent), liquid = 1 - spec.gas_content;
  return volume / (liquid + gas) *
         (liquid / spec.bulk_modulus + gas / (spec.adiabatic_exponent * spec.ambient_pressure * above));
}

template <int d>
void Compressibility<d>::pressure(const StepView<d>& step, PressureTerms& terms) {
  terms.storage.resize(step.nodes.size(), 0.0);
  in_parallel(step.nodes.size(), [&](std::size_t i) {
    const double carried = step.nodes.compression.empty() ? 0.0 : step.nodes.compression[i].pressure[0];
    terms.storage[i] += volume_per_pascal(spec_, step.lumped_volume[i], carried);
  });
}

template class Compressibility<2>;
template class Compressibility<3>;

}  // namespace splashdown::fluid
