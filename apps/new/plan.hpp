// A landing as a scene: where the hull starts, how large the tank is, when the run ends, whether half of it is enough.
//
//   start    lowest point above still water by 10 ms of sinking, between 0.5 % and 2 % of the length
//   end      contact + max(4 t_p, 2 min(H/V, pi sqrt(d/g))), t_p the time of von Karman's largest load (apps/scene/outlook), H the height
//            of the hull as it comes down, V its speed there, d = m/(rho A) its draft, A its plan area: the time to sink by its
//            own height, or half a swing in heave, twice, so that a rebound or the slap of a bow is in it. At most half a swing
//            of its breadth, from which on waves matter and ask for a finer surface
//   tank     walls and floor change the added mass by the accuracy asked at most, half of it each. A body that meets a surface acts as a
//            dipole there; its images raise the added mass (Lamb 1932, articles 99 and 137 for spheres and floor or side) by 3/16 (r/W)^3
//            a wall in space and (c/W)^2 / 2 in the plane, by 3/8 (r/D)^3 and (c/D)^2 / 2 over a floor. r: of a disc of the plan area,
//            an upper bound (a disc has 0.42 of a sphere's dipole), c: half of the breadth. Ahead the hull stays inside at its full speed
//   symmetry what apps/effects/symmetry asks of a scene
#pragma once

#include <string>
#include <vector>

#include "apps/new/hull.hpp"
#include "apps/new/options.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

struct LandingPlan {
  Scene scene;             ///< all that is written, but for element sizes
  bool symmetric = false;  ///< half of it is simulated
  std::vector<Assumption> told;
};

/// Throws NewError for numbers that no landing has.
void check_numbers(const NewOptions& options);
/// Of checked numbers. Throws NewError where they do not go together.
template <int d>
LandingPlan landing_plan(const NewOptions& options, const NewHull& hull);

}  // namespace splashdown::apps
