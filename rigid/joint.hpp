// What ties a body to another one or to the world, and what it makes of velocities.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// What a joint leaves free.
enum class JointType {
  hinge,   ///< turns about an axis through the point
  slider,  ///< moves along the axis, does not turn
  weld     ///< moves as one
};

/// Along a joint's coordinate q acts -stiffness (q - rest) - damping dq/dt [N, N m; per metre in the plane].
struct Spring {
  double stiffness = 0;  ///< [N/m, N m/rad]
  double damping = 0;    ///< [N s/m, N m s/rad]
  double rest = 0;       ///< where it is relaxed [m, rad]
};

/// Between body `body` and `other`, or the world. In two dimensions a hinge's axis is z.
/// Its coordinate q is how far `body` has moved from where `other` carries its place at t = 0: of a hinge the angle about the
/// axis, whole turns counted, of a slider the way along it.
struct JointSpec {
  JointType type = JointType::hinge;                ///< what it leaves free
  std::size_t body = 0;                             ///< index of the body
  std::optional<std::size_t> other = {};            ///< index of another body; none: the world
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< world frame, at t = 0 [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< world frame, at t = 0; unit length
  std::array<double, 2> stops = {-std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};  ///< of q [rad, m]
  std::optional<Spring> spring = {};                                        ///< along q; none: there is none

  /// Whether anything depends on q.
  bool measured() const { return spring || std::isfinite(stops[0]) || std::isfinite(stops[1]); }
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
  std::size_t body = 0;                   ///< index of the body
  std::optional<std::size_t> other = {};  ///< index of another body; none: the world
  Wrench<d> first = Wrench<d>::Zero();    ///< of the twist of `body`, about its centre of mass
  Wrench<d> second = Wrench<d>::Zero();   ///< of the twist of `other`, about its own
  double rate = 0;                        ///< right side [m/s, rad/s]
};

/// How far a joint has moved, q, and dq/dt = first . s_body + second . s_other: a condition without its rate.
template <int d>
struct JointCoordinate {
  double q = 0;       ///< [m, rad]; of a hinge in (-pi, pi]
  Condition<d> rate;  ///< dq/dt [m/s, rad/s]
};

}  // namespace splashdown::rigid
