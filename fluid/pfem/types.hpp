// Types of the fluid room: those that all rooms share. A twist is that of a wall's reference point.
#pragma once

#include "core/types.hpp"

/// The incompressible fluid with a free surface: particle finite elements.
namespace splashdown::fluid {

using splashdown::freedoms;
using splashdown::Isometry;
using splashdown::Mat;
using splashdown::rotations;
using splashdown::Surface;
using splashdown::Twist;
using splashdown::Vec;
using splashdown::Wrench;

}  // namespace splashdown::fluid
