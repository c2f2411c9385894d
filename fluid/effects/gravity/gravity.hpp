// Uniform acceleration of all water.
#pragma once

#include "fluid/effects/effect.hpp"

namespace splashdown::fluid {

/// dv = kick g, the same everywhere; potential -g . x.
template <int d>
class Gravity final : public Effect<d> {
 public:
  /// `acceleration`: g, world frame [m/s^2].
  explicit Gravity(const Vec<d>& acceleration) : g_(acceleration) {}
  std::string name() const override { return "gravity"; }
  bool keeps_rest() const override { return true; }
  Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) override;
  double potential(const Vec<d>& x) const override { return -g_.dot(x); }
  Vec<d> uniform_acceleration() const override { return g_; }
  /// energy [J]
  std::vector<Diagnostic> diagnostics(const Nodes<d>& nodes, std::span<const double> lumped_mass) const override;

 private:
  Vec<d> g_;  ///< [m/s^2]
};

extern template class Gravity<2>;
extern template class Gravity<3>;

}  // namespace splashdown::fluid
