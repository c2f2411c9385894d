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
}

}  // namespace splashdown::rigid
