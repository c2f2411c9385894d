// What a fluid on a mesh that moves with its walls is made from.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/fluid_view.hpp"
#include "fluid/ale/mesh/extension.hpp"
#include "fluid/ale/walls/moving_wall.hpp"

namespace splashdown::ale {

/// What a side of the box does to the fluid.
enum class BoundaryKind {
  inflow,   ///< velocities are given
  outflow,  ///< lets through: -p n + mu dv/dn = 1/2 rho min(v . n, 0) v
  no_slip,  ///< at rest, and the fluid with it
  slip      ///< nothing crosses it, nothing rubs
};

/// A field in space and time.
using FlowField = std::function<Vec<2>(const Vec<2>& x, double time)>;

/// How time is gone through: (v+ - v-)/k = theta F(v+) + (1 - theta) F(v-), its middle in between.
struct ThetaScheme {
  double theta = 0.5;      ///< 1/2: of second order; 1: implicit Euler
  bool is_steady = false;  ///< without the rate: each step is a steady flow
  int damped_steps = 4;    ///< implicit Euler before the first step with theta < 1 (Rannacher 1984)
};

/// When Newton's method ends.
struct IterationLimits {
  double tolerance = 1e-8;  ///< of the last change, over the greatest velocity
  int max_iterations = 30;
};

/// The load on a wall along a unit vector.
struct LoadOf {
  std::string name;
  std::size_t wall = 0;
  Vec<2> direction = Vec<2>::UnitX();
};

/// Parameters, walls and the state at t = 0.
struct AleFlowSpec {
  double density = 1000;                              ///< [kg/m^3]
  double viscosity = 1e-3;                            ///< dynamic [Pa s]
  Vec<2> min = Vec<2>::Zero(), max = Vec<2>::Ones();  ///< corners of the box [m]
  std::array<BoundaryKind, side_count> sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::slip,
                                                BoundaryKind::slip};
  FlowField inflow = {};                           ///< on inflow sides [m/s]; empty: at rest
  double far = 0.1, growth = 0.15, corner = 1;     ///< MeshSpec
  std::function<double(const Vec<2>&)> size = {};  ///< MeshSpec
  ExtensionLaw extension = ExtensionLaw::laplace;  ///< how nodes follow walls
  bool remesh = true;                              ///< a new mesh where bodies have moved theirs too far
  Vec<2> gravity = Vec<2>::Zero();                 ///< [m/s^2]
  FlowField force = {};                            ///< besides it, per mass [m/s^2]; empty: none
  FlowField start = {};                            ///< velocity at t = 0; empty: at rest
  ThetaScheme scheme = {};
  IterationLimits newton = {};
  std::vector<WallSpec<2>> walls = {};       ///< the structure's first; all stick
  std::vector<LoadOf> goals = {};            ///< loads whose errors are asked for
  std::vector<MakeMovingWall> motions = {};  ///< of walls in their order; those without one are rigid
};

/// Sides that let through.
inline std::array<bool, side_count> open_sides(const AleFlowSpec& spec) {
  std::array<bool, side_count> open{};
  for (std::size_t s = 0; s < side_count; ++s) open[s] = spec.sides[s] == BoundaryKind::outflow;
  return open;
}

}  // namespace splashdown::ale
