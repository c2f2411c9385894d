// InnerLines inside an outline that the mesh is to have edges along: where materials meet.
#pragma once

#include <array>
#include <vector>

#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// Straight pieces, from and to [m].
using InnerLines = std::vector<std::array<Vec<2>, 2>>;

/// An outline, and lines within it that end in its vertices and in each other's, and cross nothing.
struct LinedOutline {
  Points<2> vertices;
  std::vector<std::array<int, 2>> pieces;  ///< of the outline first
};

/// InnerLines are cut where they meet the outline and each other; what lies outside is left out. Points nearer than `near` to
/// each other are one [m]: those of the outline stay where they are. O(n^2) for n pieces.
LinedOutline lined(const Surface<2>& outline, const InnerLines& lines, double near);

}  // namespace splashdown::elastic
