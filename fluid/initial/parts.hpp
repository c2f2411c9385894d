// What `fill` is made of.
#pragma once

#include "fluid/initial/initial.hpp"
#include "fluid/mesh/size_field.hpp"

namespace splashdown::fluid {

/// Appends nodes on the outline of a liquid clipped by the walls, and its closed boundary; in 3D nodes within it too.
/// Throws std::invalid_argument where that outline is no surface.
template <int d>
void outline(const LiquidSpec<d>& liquid, const FluidSpec<d>& spec, const WallsAt<d>& walls, InitialLiquid<d>& out);
template <>
void outline(const LiquidSpec<2>&, const FluidSpec<2>&, const WallsAt<2>&, InitialLiquid<2>&);
template <>
void outline(const LiquidSpec<3>&, const FluidSpec<3>&, const WallsAt<3>&, InitialLiquid<3>&);

/// The wall that a point of a clipped outline lies on, to roundoff.
template <int d>
WallTie tie_at(const Vec<d>& x, const WallsAt<d>& walls);

}  // namespace splashdown::fluid
