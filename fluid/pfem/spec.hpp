// What a fluid is made from: liquid regions, walls, element sizes, time-step criterion.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/fluid_view.hpp"
#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

using splashdown::WallSpec;

/// A region filled with liquid at t = 0. It is clipped by the walls; regions may not overlap.
template <int d>
struct LiquidSpec {
  Surface<d> boundary;                            ///< world frame, closed, normals outward
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
  double cfl = 0.5;      ///< edges change by less than this share of their length
  double dt_max = 1e-2;  ///< [s]
};

/// Everything about a fluid at t = 0 but its effects. World frame.
template <int d>
struct FluidSpec {
  double density = 1000;               ///< [kg/m^3]
  SizeSpec size;                       ///< of elements
  TimeStepSpec step;                   ///< largest step
  std::vector<LiquidSpec<d>> liquids;  ///< regions, none of them over another
  std::vector<WallSpec<d>> walls;      ///< those of the structure first
  /// Called all the time while the first mesh is made, which takes minutes where it is large; what it throws ends that.
  /// Empty: nobody is asked.
  std::function<void()> while_meshing = {};
};

}  // namespace splashdown::fluid
