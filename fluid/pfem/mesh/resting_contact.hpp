// What the mesh is told of contact lines at rest.
#pragma once

#include <functional>

namespace splashdown::fluid {

/// Whether the contact line rests at a node of it, this far from a corner or an edge of its wall [m].
using RestingContact = std::function<bool(int node, double length)>;
/// Of contact lines none of which rests.
inline bool moves_anywhere(int, double) { return false; }

}  // namespace splashdown::fluid
