// How many nodes a mesh will have, before it is made.
#pragma once

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// Nodes of flow_mesh(spec), within some per cent: integrals over the fluid of 1/h^2 and over its boundary of 1/h, where h is
/// the edge that is asked for. Of more than a million it finds a fifth too few. The work is bounded. Throws as hull_lines does.
double foreseen_nodes(const MeshSpec& spec);

}  // namespace splashdown::ale
