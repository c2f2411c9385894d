// Nodes as the fluid room names them: as they are looked at.
#pragma once

#include "core/nodes.hpp"
#include "fluid/parallel.hpp"
#include "fluid/types.hpp"

namespace splashdown::fluid {

using splashdown::Nodes;
using splashdown::VelocityMoments;
using splashdown::WallTie;

}  // namespace splashdown::fluid
