// Geometry as the fluid room names it: that of all rooms.
#pragma once

#include "core/geometry.hpp"
#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

using splashdown::area_vector;
using splashdown::moved;
using splashdown::rigid_velocity;
using splashdown::volume;
using splashdown::volume_gradients;
using splashdown::wrench_of;

}  // namespace splashdown::fluid
