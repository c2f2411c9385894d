// The liquid at t = 0: regions clipped by walls, meshed to the size field.
#pragma once

#include "fluid/mesh/recognise.hpp"
#include "fluid/spec.hpp"

namespace splashdown::fluid {

template <int d>
struct InitialLiquid {
  Nodes<d> nodes;
  Mesh<d> mesh;
  std::vector<double> h;  ///< element size at the nodes [m]
};

/// Throws std::invalid_argument if no liquid remains.
template <int d>
InitialLiquid<d> fill(const FluidSpec<d>& spec, const WallsAt<d>& walls);

}  // namespace splashdown::fluid
