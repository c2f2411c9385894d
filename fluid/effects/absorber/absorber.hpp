// A numerical beach: waves that enter a zone at an end of the tank die out in it.
//
//   dv/dt = - r(x) v,   r = rate (1 - s / width)^2 at the distance s < width from an end
//
// Integrated exactly over a kick. The quadratic ramp keeps the zone's edge from reflecting; longest wave that
// is absorbed well: about the zone's width (Larsen, Dancy, Coastal Eng. 7, 1983).
#pragma once

#include "fluid/effects/effect.hpp"

namespace splashdown::fluid {

/// Zones at the ends along the first axis.
struct AbsorberSpec {
  double from = 0;                  ///< the tank's lower end on the first axis [m]
  double to = 0;                    ///< its upper end [m]
  double width = 0;                 ///< of each zone [m]
  double rate = 0;                  ///< at the ends [1/s]
  bool lower = true, upper = true;  ///< there is a zone at this end
};

/// dv = (exp(-r kick) - 1) v at each node; walls get nothing.
template <int d>
class Absorber final : public Effect<d> {
 public:
  /// Takes the values as they are: readers check them.
  explicit Absorber(const AbsorberSpec& spec) : spec_(spec) {}
  std::string name() const override { return "absorber"; }
  bool keeps_rest() const override { return true; }
  Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) override;
  /// power: rate of change of the kinetic energy [W]
  std::vector<Diagnostic> diagnostics(const Nodes<d>&, std::span<const double>) const override {
    return {{"power", power_}};
  }

 private:
  double rate_at(const Vec<d>& x) const;

  AbsorberSpec spec_;
  double power_ = 0;
};

extern template class Absorber<2>;
extern template class Absorber<3>;

}  // namespace splashdown::fluid
