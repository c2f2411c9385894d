#include "rigid/joint.hpp"

#include <stdexcept>

#include "rigid/message.hpp"

namespace splashdown::rigid {

void check(const JointSpec& joint, std::size_t bodies) {
  const auto require = [](bool fine, const auto&... text) {
    if (!fine) throw std::invalid_argument(message("joint: ", text...));
  };
  require(joint.body < bodies, "it ties body ", joint.body, ", there are ", bodies);
  require(!joint.other || *joint.other < bodies, "it ties body ", joint.other.value_or(0), ", there are ", bodies);
  require(joint.other != joint.body, "it ties a body to itself");
  require(joint.point.allFinite(), "its point is not finite");
  require(joint.axis.allFinite() && joint.axis.norm() > 0, "its axis has no direction");
  require(joint.type != JointType::weld || !joint.measured(), "a weld has neither stops nor a spring");
  require(joint.stops[0] <= 0 && joint.stops[1] >= 0, "its place at t = 0 is beyond its stops");
  if (!joint.spring) return;
  const auto& [stiffness, damping, rest] = *joint.spring;
  require(std::isfinite(stiffness) && std::isfinite(damping) && std::isfinite(rest), "its spring is not finite");
  require(stiffness >= 0 && damping >= 0, "its spring gives energy");
}

}  // namespace splashdown::rigid
