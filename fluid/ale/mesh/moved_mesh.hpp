// A new mesh around hulls that have moved: the rules and the division of the first one, where walls are now.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fluid/ale/mesh/hull_line.hpp"

namespace splashdown::ale {

/// A mesh, and where its nodes on hulls were at t = 0.
struct MovedMesh {
  FlowMesh mesh;   ///< now [m]
  Nodes at_start;  ///< of all nodes; of those that are on no hull as they are now [m]
};

/// Where points of walls are now that were there at t = 0 [m]; `walls`: of each point.
using PlaceOnWalls = std::function<Nodes(std::span<const int> walls, const Nodes& at_start)>;

/// `first`: outlines at t = 0, divided. Edges that are bent by more than a radian now are halved. Throws
/// std::invalid_argument as flow_mesh does, and for cells that the curves of hulls fold.
MovedMesh moved_mesh(const MeshSpec& spec, std::vector<HullLine> first, const PlaceOnWalls& place);

}  // namespace splashdown::ale
