#include "fluid/effects/gravity/gravity.hpp"

namespace splashdown::fluid {

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

template class Gravity<2>;
template class Gravity<3>;

}  // namespace splashdown::fluid
