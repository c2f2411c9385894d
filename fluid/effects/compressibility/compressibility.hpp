// A liquid that pressure compresses, with gas in bubbles that do not move through it:
//
//   rho_0 / rho = (1 - a) (1 + K' p / K)^(-1/K') + a (1 + p / p_a)^(-1/gamma)
//
// a: share of the volume that is gas where the pressure is 0, p_a the ambient pressure there; Murnaghan's (1944) law of the
// liquid, with K' = 0 its limit exp(-p / K). Without gas and for p << K it is linear acoustics, c = sqrt(K / rho). In time
// (compression.hpp) of second order, bounded by no step; waves are resolved where a step is shorter than an element over c, and
// damped where it is much longer.
#pragma once

#include "fluid/effects/effect.hpp"

namespace splashdown::fluid {

/// Of the liquid and the gas in it.
struct CompressibilitySpec {
  double bulk_modulus = 2.2e9;       ///< K [Pa]
  double bulk_modulus_slope = 0;     ///< K' = dK/dp
  double gas_content = 0;            ///< share of the volume at ambient pressure, from 0 to below 1
  double ambient_pressure = 101325;  ///< where the pressure is 0 [Pa]
  double adiabatic_exponent = 1.4;   ///< gamma of the gas
};

/// At a pressure against ambient [Pa]. Tension makes at most 27 times more of the gas, and takes at most half of K.
LiquidState liquid_state(const CompressibilitySpec& spec, double pressure);

/// The liquid of all nodes.
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
