// Keeps the node spacing near the size field: splits long edges, merges short ones, deletes inner nodes
// that crowd a boundary. Works on the old mesh with its moved nodes; the closed boundary stays closed.
//
// Split at the midpoint above 1.5 h, merge below 0.45 h: a split edge is not merged again, a merged one
// not split. Velocities are averaged, so a merge keeps momentum to second order.
//
// A contact line near a corner or an edge of its wall is merged into it, or else a jet that passes it would need steps as short
// as the edge between them. That moves the surface. Where the contact line rests it stays: still water keeps its level.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/mesh/resting_contact.hpp"

namespace splashdown::fluid {

inline constexpr double merge_below = 0.45;  ///< length of an edge over h

/// How many nodes came and went.
template <int d>
struct AdaptReport {
  int inserted = 0, removed = 0;
};

/// Changes nodes and boundary (mesh.cells become stale) and renumbers.
template <int d>
AdaptReport<d> adapt(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& walls,
                     const RestingContact& rests = moves_anywhere);

/// Keeps these nodes alone and renumbers; all nodes of the boundary must be among them.
template <int d>
void keep(const std::vector<int>& kept, Nodes<d>& nodes, std::vector<Facet<d>>& boundary);

/// Keeps all nodes but those that are marked; false if none is.
template <int d>
bool discard(const std::vector<char>& marked, Nodes<d>& nodes, std::vector<Facet<d>>& boundary);

}  // namespace splashdown::fluid
