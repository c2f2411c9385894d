// A liquid that pressure compresses, with gas in bubbles that do not move through it:
//
//   dV/V = - (a_l / K + a_g / (gamma p)) dp
//
// a_l, a_g: shares of the volume that are liquid and gas, p the absolute pressure. Without gas it is linear acoustics,
// c = sqrt(K / rho): density and mass stay what they are. In time (compression.hpp) of second order,
// bounded by no step; waves are resolved where a step is shorter than an element over c, and damped where it is much longer.
#pragma once

#include "fluid/effects/effect.hpp"

namespace splashdown::fluid {

/// Of the liquid and the gas in it.
struct CompressibilitySpec {
  double bulk_modulus = 2.2e9;       ///< K [Pa]
  double gas_content = 0;            ///< share of the volume at ambient pressure, from 0 to below 1
  double ambient_pressure = 101325;  ///< where the pressure is 0 [Pa]
  double adiabatic_exponent = 1.4;   ///< gamma of the gas
};

/// - dV/dp of a volume V [m^d/Pa], at a pressure against ambient.
double volume_per_pascal(const CompressibilitySpec& spec, double volume, double pressure);

/// Storage at every node.
template <int d>
class Compressibility final : public Effect<d> {
 public:
  /// Takes the values as they are: readers check them.
  explicit Compressibility(const CompressibilitySpec& spec) : spec_(spec) {}
  std::string name() const override { return "compressibility"; }
  Status predict(const StepView<d>&, const Carried<d>&, const Predicted<d>&) override { return {}; }
  void pressure(const StepView<d>& step, PressureTerms& terms) override;

 private:
  CompressibilitySpec spec_;
};

extern template class Compressibility<2>;
extern template class Compressibility<3>;

}  // namespace splashdown::fluid
