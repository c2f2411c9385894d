// Elements of narrow strips: where a contact line rests near an edge of its wall, as around a shallow hull afloat, the wall is
// wet on a strip narrower than its elements. A Delaunay triangulation has the edges of both lines only if their nodes are not
// much farther apart than the lines are; else cells cut the strip off, and with it water that carries the hull.
//
//   h <= max(w, h_0 / 10) + 0.45 r   at the distance r from a strip of width w, h_0: without strips
//
// In 3D. In 2D the strip is one edge, however short. Adds elements in proportion to the length of the strips: at w = h_0 / 10,
// where they are most, about 20 for each h_0 of it.
#pragma once

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/resting_contact.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Makes nodes.h [m] smaller around strips along contact lines that rest.
void resolve_narrow_strips(Nodes<3>& nodes, const Mesh<3>& mesh, const RestingContact& rests);

}  // namespace splashdown::fluid
