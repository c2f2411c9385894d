// The mesh as the fluid room names it: as it is looked at.
#pragma once

#include "core/mesh.hpp"
#include "fluid/geometry.hpp"
#include "fluid/parallel.hpp"

namespace splashdown::fluid {

using splashdown::area_vector_of;
using splashdown::corners;
using splashdown::corners_of;
using splashdown::enclosed_volume;
using splashdown::Facet;
using splashdown::facet_nodes;
using splashdown::Mesh;
using splashdown::nodal_volumes;
using splashdown::nodes_of;
using splashdown::opposite;
using splashdown::wetted_measures;

}  // namespace splashdown::fluid
