// The mesh that a flow is made with.
#pragma once

#include "fluid/ale/spec.hpp"

namespace splashdown::ale {

/// Box, sizes, and its walls where they are at t = 0.
MeshSpec mesh_spec(const AleFlowSpec& spec);

}  // namespace splashdown::ale
