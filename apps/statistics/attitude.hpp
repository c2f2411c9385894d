// Attitude of a body in the angles of ships and aircraft, from the rotation of its shape's frame.
//
//   3D  R = Rz(heading) Ry(-pitch) Rx(roll)   heading counter-clockwise from above, pitch nose (x axis) up, roll by the
//                                             right hand about x; pitch within +-90 degrees
//   2D  R = R(pitch)                          counter-clockwise; roll and heading are zero
#pragma once

#include <array>

#include "core/types.hpp"

namespace splashdown::apps {

inline constexpr std::array attitude_names = {"roll", "pitch", "heading"};
/// Roll, pitch, heading [deg].
using Angles = std::array<double, 3>;

template <int d>
Angles attitude_deg(const Eigen::Matrix<double, d, d>& rotation);

/// The angle of the same direction that is nearest to `before`: no jumps by whole turns [deg].
double continued(double angle, double before);

/// Angle between the body's own up axis (the last axis of its shape's frame) and the world's, 0 to 180 [deg].
template <int d>
double tilt_deg(const Eigen::Matrix<double, d, d>& rotation);

}  // namespace splashdown::apps
