// Which water hangs together: cells that share nodes.
#pragma once

#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"

namespace splashdown::fluid {

/// Of each of `nodes` nodes the first one of its part; nodes without cells are parts by themselves. O(cells).
template <int d>
std::vector<int> parts_of(const Mesh<d>& mesh, std::size_t nodes);

/// The same of some nodes alone, which hang together by cells that share two of them; -1: not `among` them.
template <int d>
std::vector<int> parts_of(const Mesh<d>& mesh, const std::vector<char>& among);

extern template std::vector<int> parts_of(const Mesh<2>&, std::size_t);
extern template std::vector<int> parts_of(const Mesh<3>&, std::size_t);
extern template std::vector<int> parts_of(const Mesh<2>&, const std::vector<char>&);
extern template std::vector<int> parts_of(const Mesh<3>&, const std::vector<char>&);

}  // namespace splashdown::fluid
