// The load of an impact over time by closed formulas, for shapes that have them: wedges and cones that enter upright, circles, spheres.
//
//   F = d(M_a V)/dt = V_0^2 M_a' / (1 + M_a/m)^3,   (m + M_a) V = m V_0,   M_a' = dM_a/d(depth)
//   M_a = pi/2 rho c^2 in the plane, 4/3 rho c^3 in space: half of what a plate moves that is as wide as the wetted hull, 2c
//
// von Karman (1929) takes the hull's width where still water would meet it. Wagner (1932) lets the water rise beside it: the depth is
// multiplied by pi/2 (wedge), 2 (circle), 4/pi (cone), 3/2 (sphere). Loads lie between as a rule; weight and buoyancy are left out.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/outlook/outlook.hpp"

namespace splashdown::apps {

struct ImpactTheory {
  std::vector<double> time;  ///< from the contact until Wagner's water reaches the hull's full width, or the end [s]
  std::vector<double> karman, wagner;  ///< load upwards [N, N/m]
};

/// Of the body that enters; nothing without a formula for it.
std::optional<ImpactTheory> impact_theory(const Outlook& look);

}  // namespace splashdown::apps
