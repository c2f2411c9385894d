// Forces that somebody gives: thrust, a crane, a push.
//
//   F(t), M(t) + r x F(t),   in the world's axes or turned with the body
#pragma once

#include "rigid/forces/curve.hpp"
#include "rigid/forces/force.hpp"

namespace splashdown::rigid {

/// One of them.
template <int d>
struct AppliedForceSpec {
  std::size_t body = 0;             ///< among all
  Curve<d> force = {};              ///< over time [N, N/m]
  Curve<rotations<d>> moment = {};  ///< over time, about the centre of mass [N m, N]
  bool turns_with_body = false;     ///< components are along the body's axes
  Vec<d> point = Vec<d>::Zero();    ///< r: where the force acts, body frame [m]
};

/// Forces and moments over time.
template <int d>
class AppliedForces final : public Force<d> {
 public:
  /// Forces in the order of the scene.
  explicit AppliedForces(std::vector<AppliedForceSpec<d>> specs) : specs_(std::move(specs)) {}
  std::string name() const override { return "force"; }
  void add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const override;

 private:
  std::vector<AppliedForceSpec<d>> specs_;
};

extern template class AppliedForces<2>;
extern template class AppliedForces<3>;

}  // namespace splashdown::rigid
