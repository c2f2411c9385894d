// Gaps between walls that no first mesh fills, in space: they are refused with their place.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "fluid/pfem/initial/initial.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"

namespace splashdown::fluid {

/// Throws GapRefused where an edge of the liquid's outline runs within a hundredth of h beside an edge of a wall
/// that it does not lie on. Mesh_3 gives edges elements as short as their distance: a gap of a thousandth of h takes minutes.
void refuse_narrow_gaps(std::span<const std::array<Vec<3>, 2>> edges, const SizeField<3>& size,
                        const WallsAt<3>& walls);

/// A triangle of the liquid's outline, normal outward, and the wall it lies on; -1: free surface.
struct SkinFacet {
  std::array<Vec<3>, 3> corners;
  int wall;
};

/// The gap between facing walls that is narrowest over h, if it is less than `filled_gap` wide there. Walls that touch each other
/// somewhere have no gap between them. O(n log n) in the facets and the elements beside narrow gaps.
std::optional<Gap> narrowest_gap(std::span<const SkinFacet> skin, const SizeSpec& spec, const SizeField<3>& size,
                                 const WallsAt<3>& walls);

/// Throws GapRefused where the mesh leaves a hole between two walls: a facet between nodes of both that lies on
/// neither, nor on the surface of a liquid. Water would fall into it.
void refuse_holes(const InitialLiquid<3>& mesh, std::span<const LiquidSpec<3>> liquids, const WallsAt<3>& walls);

}  // namespace splashdown::fluid
