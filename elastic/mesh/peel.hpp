// Flat cells at the boundary of a mesh of tetrahedra.
#pragma once

#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// Cells of a mean ratio below `flat` whose sides on the boundary all but lie in a plane are taken away: the boundary has the
/// other diagonal then, and encloses less by the cells' volume, which is next to nothing.
Simplices<3> peeled(const Points<3>& corners, Simplices<3> cells, double flat);

}  // namespace splashdown::elastic
