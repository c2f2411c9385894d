// Lengths and areas of a hull as it comes down.
#pragma once

#include <cmath>
#include <numbers>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {

/// Of the hull in its attitude, its reference point at the origin.
template <int d>
struct Measures {
  Extents<d> box;
  double length = 0, breadth = 0, height = 0;  ///< along x, across (in the plane that along x), upward [m]
  double plan = 0;                             ///< area, breadth seen from above [m^2, m]
  double volume = 0;

  /// Half of the breadth in the plane, the radius of a disc of the plan area in space [m].
  double reach() const { return d == 2 ? plan / 2 : std::sqrt(plan / std::numbers::pi); }
};

template <int d>
Measures<d> measures_of(const Body& body);

}  // namespace splashdown::apps
