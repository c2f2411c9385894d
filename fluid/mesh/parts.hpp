// Which water hangs together: cells that share nodes.
#pragma once

#include <vector>

#include "fluid/mesh/mesh.hpp"

namespace splashdown::fluid {

/// Of each of `nodes` nodes the first one of its part; nodes without cells are parts by themselves. O(cells).
template <int d>
std::vector<int> parts_of(const Mesh<d>& mesh, std::size_t nodes);

extern template std::vector<int> parts_of(const Mesh<2>&, std::size_t);
extern template std::vector<int> parts_of(const Mesh<3>&, std::size_t);

}  // namespace splashdown::fluid
