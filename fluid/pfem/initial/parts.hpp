// What `fill` is made of.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/initial/initial.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"

namespace splashdown::fluid {

/// Appends nodes on the outline of a liquid clipped by the walls, and its closed boundary; in 3D nodes within it too.
/// Throws std::invalid_argument where that outline is no surface.
template <int d>
void outline(const LiquidSpec<d>& liquid, const FluidSpec<d>& spec, const WallsAt<d>& walls, InitialLiquid<d>& out);
template <>
void outline(const LiquidSpec<2>&, const FluidSpec<2>&, const WallsAt<2>&, InitialLiquid<2>&);
template <>
void outline(const LiquidSpec<3>&, const FluidSpec<3>&, const WallsAt<3>&, InitialLiquid<3>&);

/// What can be told of an outline before it is meshed.
struct OutlineSketch {
  bool is_empty = true;
  std::optional<Gap> gap = {};  ///< the narrowest that the mesh may not fill
};

/// Throws what `outline` throws before it makes a mesh.
template <int d>
OutlineSketch sketch(const LiquidSpec<d>& liquid, const FluidSpec<d>& spec, const WallsAt<d>& walls);
template <>
OutlineSketch sketch(const LiquidSpec<2>&, const FluidSpec<2>&, const WallsAt<2>&);
template <>
OutlineSketch sketch(const LiquidSpec<3>&, const FluidSpec<3>&, const WallsAt<3>&);

/// The boundaries of liquids as they were asked for, to measure distances from.
template <int d>
std::vector<Wall<d>> outlines_of(std::span<const LiquidSpec<d>> liquids) {
  std::vector<Wall<d>> outlines;
  for (const auto& liquid : liquids)
    outlines.emplace_back(WallSpec<d>{"", liquid.boundary, Isometry<d>::Identity(), Twist<d>::Zero(), 0});
  return outlines;
}

/// Distance of points on a wall, over its size: roundoff of the clipping.
inline constexpr double on_wall = 1e-9;

/// The wall that a point of a clipped outline lies on, to roundoff.
template <int d>
WallTie tie_at(const Vec<d>& x, const WallsAt<d>& walls);

}  // namespace splashdown::fluid
