// How nodes get onto walls: those that reach a wall are tied to it and slide there, and its corners and creases get nodes of
// their own as soon as they are wetted. Only fluid carries nodes: there are no dry wall nodes, so no cell spans a gap and
// contact neither creates volume nor happens early.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/recognition/recognise.hpp"

namespace splashdown::fluid {

/// Ties nodes that have reached a wall, to the side that they came from; puts nodes at wetted corners and creases, true if
/// there were any. `velocities`: of the walls; `dt`: since nodes and walls moved with theirs [s].
template <int d>
bool attach_nodes(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& walls, std::span<const WallVelocity<d>> velocities,
                  double dt);

extern template bool attach_nodes(Nodes<2>&, Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>, double);
extern template bool attach_nodes(Nodes<3>&, Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>, double);

}  // namespace splashdown::fluid
