// Several closed surfaces as one.
#pragma once

#include <span>

#include "core/types.hpp"

namespace splashdown {

/// The boundary of the union of the solids that `parts` bound [m], normals outward: several loops or shells where they lie apart,
/// and those of voids. Each part is closed, normals outward, without crossings. By CGAL's regularised Boolean operations (plane,
/// exact constructions) and corefinement (space, exact predicates); O(n log n). Throws std::invalid_argument where the union is
/// not the surface of a solid: parts that touch in an edge or a point alone.
template <int d>
Surface<d> united(std::span<const Surface<d>> parts);

template <>
Surface<2> united<2>(std::span<const Surface<2>>);
template <>
Surface<3> united<3>(std::span<const Surface<3>>);

}  // namespace splashdown
