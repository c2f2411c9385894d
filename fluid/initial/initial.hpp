// The liquid at t = 0: regions clipped by walls, meshed to the size field.
#pragma once

#include "fluid/mesh/recognise.hpp"
#include "fluid/spec.hpp"

namespace splashdown::fluid {

template <int d>
struct InitialLiquid {
  Nodes<d> nodes;
  Mesh<d> mesh;
};

/// Throws std::invalid_argument if no liquid remains.
template <int d>
InitialLiquid<d> fill(const FluidSpec<d>& spec, const WallsAt<d>& walls);

}  // namespace splashdown::fluid
