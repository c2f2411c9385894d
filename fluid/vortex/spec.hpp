// What a fluid on a grid is made from.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/fluid_view.hpp"
#include "fluid/vortex/grid.hpp"
#include "fluid/vortex/poisson/stream_function.hpp"
#include "fluid/vortex/transport/advection.hpp"
#include "fluid/vortex/transport/diffusion.hpp"

namespace splashdown::vortex {

/// How bodies are kept rigid inside the fluid.
struct Penalisation {
  double smoothing = 0;             ///< half width of chi's ramp, in squares; 0: sharp
  std::optional<double> rate = {};  ///< lambda [1/s]; absent: its limit, a projection
  int passes = 0;                   ///< of the projection for bodies that the fluid moves; 0: chosen (fluid.hpp)
  int prescribed_passes = 1;        ///< for all others
};

/// Parameters, walls and the state at t = 0.
struct GridFlowSpec {
  double density = 1000;                 ///< [kg/m^3]
  double viscosity = 0;                  ///< kinematic [m^2/s]
  Grid grid;                             ///< nx and ny multiples of FarField::coarsening
  SideKind sides = SideKind::free;       ///< of the grid
  std::function<Vec<2>(double)> stream;  ///< velocity far away at a time [m/s]; empty: at rest
  Vec<2> gravity = Vec<2>::Zero();       ///< [m/s^2]
  Penalisation penalisation;
  Remeshing remeshing = Remeshing::m4;
  PathRule paths = PathRule::rk2;
  int diffusion_order = 2;         ///< 2 or 4
  double cfl = 0.5;                ///< squares that fluid may cross in a step
  std::vector<WallSpec<2>> walls;  ///< the structure's first
  NodeField vorticity = {};        ///< at t = 0 [1/s]; empty: none
};

}  // namespace splashdown::vortex
