#include "fluid/effects/effect.hpp"

#include <limits>

namespace splashdown::fluid {

template <int d>
double Effect<d>::stable_dt() const {
  return std::numeric_limits<double>::infinity();
}

template <int d>
Status Gravity<d>::predict(const StepView<d>& step, const Carried<d>&, const Predicted<d>& predicted) {
  for (auto& u : predicted.v) u += step.kick * g_;
  return {};
}

template <int d>
std::vector<Diagnostic> Gravity<d>::diagnostics(const Nodes<d>& nodes, std::span<const double> lumped_mass) const {
  double energy = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) energy += lumped_mass[i] * potential(nodes.x[i]);
  return {{"energy", energy}};
}

template class Effect<2>;
template class Effect<3>;
template class Gravity<2>;
template class Gravity<3>;

}  // namespace splashdown::fluid
