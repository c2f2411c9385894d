#include "fluid/effects/absorber/absorber.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splashdown::fluid {

template <int d>
double Absorber<d>::rate_at(const Vec<d>& x) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  const double into =
      1 - std::min(spec_.lower ? x[0] - spec_.from : far, spec_.upper ? spec_.to - x[0] : far) / spec_.width;
  const double ramp = std::clamp(into, 0.0, 1.0);
  return spec_.rate * ramp * ramp;
}

template <int d>
Status Absorber<d>::predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) {
  double energy = 0;
  for (std::size_t i = 0; i < step.nodes.size(); ++i) {
    const double rate = rate_at(step.nodes.x[i]);
    if (rate == 0) continue;
    const double loss = std::expm1(-rate * step.kick);
    predicted.v[i] += loss * carried.v[i];
    energy += 0.5 * loss * (2 + loss) * step.density * step.lumped_volume[i] * carried.v[i].squaredNorm();
  }
  power_ = energy / step.kick;
  return {};
}

template class Absorber<2>;
template class Absorber<3>;

}  // namespace splashdown::fluid
