// Types of the rigid-body room: those that all rooms share. Twists and wrenches are those of the centre of
// mass; a surface encloses the solid.
#pragma once

#include "core/types.hpp"

/// Rigid bodies with joints and contacts, and their hydrostatics.
namespace splashdown::rigid {

using splashdown::freedoms;
using splashdown::Inertia;
using splashdown::Isometry;
using splashdown::rotations;
using splashdown::Surface;
using splashdown::Twist;
using splashdown::Vec;
using splashdown::Wrench;

/// A rotation vector [rad] or an angular velocity [rad/s]: one entry in 2D.
template <int d>
using Rotation = Eigen::Matrix<double, rotations<d>, 1>;
}  // namespace splashdown::rigid
