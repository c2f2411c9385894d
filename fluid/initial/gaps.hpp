// Gaps between walls that no first mesh fills, in space: they are refused with their place.
#pragma once

#include <array>
#include <span>

#include "fluid/initial/initial.hpp"
#include "fluid/mesh/size_field.hpp"

namespace splashdown::fluid {

/// Throws std::invalid_argument where an edge of the liquid's outline runs within a hundredth of h beside an edge of a wall
/// that it does not lie on. Mesh_3 gives edges elements as short as their distance: a gap of a thousandth of h takes minutes.
void refuse_narrow_gaps(std::span<const std::array<Vec<3>, 2>> edges, const SizeField<3>& size,
                        const WallsAt<3>& walls);

/// Throws std::invalid_argument where the mesh leaves a hole between two walls: a facet between nodes of both that lies on
/// neither, nor on the surface of a liquid. Water would fall into it.
void refuse_holes(const InitialLiquid<3>& mesh, std::span<const LiquidSpec<3>> liquids, const WallsAt<3>& walls);

}  // namespace splashdown::fluid
