#include "rigid/body.hpp"

#include <cmath>
#include <stdexcept>

#include "rigid/message.hpp"

namespace splashdown::rigid {

template <int d>
double reach(const BodySpec<d>& spec) {
  const double farthest = spec.surface.vertices.cols() > 0 ? spec.surface.vertices.colwise().norm().maxCoeff() : 0.0;
  return farthest > 0 ? farthest : 1.0;
}

template <int d>
void check(const BodySpec<d>& spec) {
  const auto require = [&](bool fine, const auto&... text) {
    if (!fine) throw std::invalid_argument(message("body \"", spec.name, "\": ", text...));
  };
  const double round_off = 1e-9;  // of a rotation or an inertia given with nine digits

  const auto& rotation = spec.pose.linear();
  require(spec.pose.matrix().allFinite(), "the initial pose is not finite");
  require((rotation.transpose() * rotation).isIdentity(round_off) && rotation.determinant() > 0,
          "the initial orientation is not a rotation (determinant ", rotation.determinant(), ")");
  require(spec.velocity.allFinite(), "the initial velocity is not finite");
  require(spec.motion != BodyMotion::prescribed || spec.path, "prescribed motion needs a path");
  require(spec.motion == BodyMotion::prescribed || !spec.release, "only prescribed motion ends with a release");
  if (!spec.becomes_free()) return;

  require(std::isfinite(spec.mass) && spec.mass >= 0, "mass is ", spec.mass,
          "; a body that moves freely needs a positive mass, or none and the water's inertia");
  if (spec.mass == 0) return require(spec.inertia.isZero(0), "it has a moment of inertia and no mass");
  require(spec.inertia.allFinite() && spec.inertia.isApprox(spec.inertia.transpose(), round_off),
          "the moment of inertia is not a finite symmetric tensor");
  const double smallest = spec.inertia.template selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
  require(smallest > 0, "the smallest moment of inertia is ", smallest,
          "; a body that moves freely needs a positive one about every axis");
}

template double reach<2>(const BodySpec<2>&);
template double reach<3>(const BodySpec<3>&);
template void check<2>(const BodySpec<2>&);
template void check<3>(const BodySpec<3>&);

}  // namespace splashdown::rigid
