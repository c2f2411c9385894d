// What a step hands to the water: the one thing that the water takes in, whatever has found it.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/contact/wall_motion.hpp"
#include "fluid/pfem/mesh/conservation/free_water.hpp"
#include "fluid/pfem/mesh/node_cells.hpp"
#include "fluid/pfem/step_result.hpp"

namespace splashdown::fluid {

/// A motion from t_n to t_{n+1} on the mesh of t_n. Entries are of nodes unless said.
template <int d>
struct Motion {
  double kick, dt;                                 ///< [s]
  const StepResult<d>& found;                      ///< loads, pressures, ledger
  const WallMotion<d>& at_walls;                   ///< what walls do to nodes
  std::span<const Vec<d>> v;                       ///< at t_{n+1/2}, before walls guide them [m/s]
  const NodeCells<d>& around;                      ///< the cells around each node
  std::span<const double> lumped_volume;           ///< at t_n [m^d]
  std::span<const int> unknown;                    ///< number of its pressure, -1: p = 0
  std::span<const double> repaired;                ///< impulses of the repair, of unknowns [Pa s]
  const typename FreeWater<d>::Moments& unloaded;  ///< of free water, before the pressure
  std::vector<double> meant;                       ///< volume that effects have made; empty: none [m^d]
  std::vector<Compressed> compression;             ///< at t_{n+1/2}; empty: of an incompressible liquid
  double energy_of_repair;                         ///< what the repair has added [J]
};

}  // namespace splashdown::fluid
