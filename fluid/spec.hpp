// What a fluid is made from: liquid regions, walls, element sizes, time-step criterion.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/fluid_view.hpp"
#include "fluid/types.hpp"

namespace splashdown::fluid {

using splashdown::WallSpec;

/// A region filled with liquid at t = 0. It is clipped by the walls; regions may not overlap.
template <int d>
struct LiquidSpec {
  Surface<d> boundary;
  std::function<Vec<d>(const Vec<d>&)> velocity;  ///< initial velocity field; empty: at rest
};

/// h(x) = min over sources of (h_source + growth * distance), at most `far`.
struct SizeSpec {
  double surface = 0;          ///< at the free surface [m]
  double far = 0;              ///< largest element [m]
  double growth = 0.15;        ///< dh/dx; the wedges of docs/validation.md use 0.2
  double wetted_fraction = 0;  ///< at a wall h is at least this fraction of its wetted half length
  /// At hollows of the free surface (the root of a jet) h is this fraction of their radius of curvature ...
  double hollow = std::numeric_limits<double>::infinity();
  double hollow_min = 0;  ///< ... but not below this [m]
  /// At a wall h is at most this fraction of the outline's radius of curvature (`size_at_bend`).
  double curvature = 0.5;
  double corner = 1;  ///< at corners of hulls h is at most this fraction of what it is on the hull
};

/// dt = min(cfl * min over edges of length / |relative velocity|, min over nodes of sqrt(h / |a|) / 2, dt_max): the
/// norm of the difference of the edge's end velocities, whatever its direction, and a, the acceleration of the
/// nodes over the last step. Effects may ask for less.
struct TimeStepSpec {
  double cfl = 0.5;
  double dt_max = 1e-2;
};

template <int d>
struct FluidSpec {
  double density = 1000;  ///< [kg/m^3]
  SizeSpec size;
  TimeStepSpec step;
  std::vector<LiquidSpec<d>> liquids;
  std::vector<WallSpec<d>> walls;
  /// Called all the time while the first mesh is made, which takes minutes where it is large; what it throws ends that. Empty: nobody
  /// is asked.
  std::function<void()> while_meshing = {};
};

}  // namespace splashdown::fluid
