// Weight of bodies.
#pragma once

#include "rigid/forces/force.hpp"

namespace splashdown::rigid {

/// m g at the centre of mass.
template <int d>
class Gravity final : public Force<d> {
 public:
  /// `acceleration`: g, world frame [m/s^2].
  explicit Gravity(const Vec<d>& acceleration) : acceleration_(acceleration) {}
  std::string name() const override { return "gravity"; }
  void add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const override;

 private:
  Vec<d> acceleration_;
};

extern template class Gravity<2>;
extern template class Gravity<3>;

}  // namespace splashdown::rigid
