// What ties a body to another one or to the world, and what it makes of velocities.
#pragma once

#include <cstddef>
#include <optional>

#include "rigid/types.hpp"

namespace splashdown::rigid {

enum class JointType {
  hinge,   ///< turns about an axis through the point
  slider,  ///< moves along the axis, does not turn
  weld     ///< moves as one
};

/// Between body `body` and `other`, or the world. In two dimensions a hinge's axis is z.
struct JointSpec {
  JointType type = JointType::hinge;
  std::size_t body = 0;
  std::optional<std::size_t> other = {};
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< world frame, at t = 0 [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< world frame, at t = 0; unit length
};

/// Throws std::invalid_argument unless the joint ties two of so many bodies, or one to the world, about an axis.
void check(const JointSpec& joint, std::size_t bodies);

/// One condition on the velocities of a body and another one, or the world:
///
///   first . s_body + second . s_other  =  rate     (of contacts: >= rate)
///
/// Action and reaction: `second` is minus the same wrench, about the other centre.
/// `rate` removes over the step what positions violate at its beginning, so that errors do not add up.
template <int d>
struct Condition {
  std::size_t body = 0;
  std::optional<std::size_t> other = {};
  Wrench<d> first = Wrench<d>::Zero(), second = Wrench<d>::Zero();
  double rate = 0;
};

}  // namespace splashdown::rigid
