// The surface of a solid as walls have it: flat facets between all nodes of the boundary, middles of edges included. A quadratic
// edge gives two facets, a quadratic face four; on curved sides they are chords, O(h^2/4) from the curve.
#pragma once

#include <vector>

#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// A closed surface whose vertices are nodes of a solid.
template <int d>
struct Boundary {
  Surface<d> surface;      ///< normals point out of the solid [m]
  std::vector<int> nodes;  ///< of its vertices, ascending
};

/// Of the solid at rest, in the frame of the mesh.
template <int d>
Boundary<d> boundary_of(const SolidMesh<d>& mesh);

}  // namespace splashdown::elastic
