// How far a displacement or a natural frequency is off, by the solid of which each cell is divided (Becker & Rannacher 2001;
// Heuveline & Rannacher 2001 for eigenvalues). With P u what a field is there, and I interpolation on the cells before:
//
//   deflection  J(u) - J = -r . (z - I z),    r = F - f(P u),              K(P u) z = dJ/du
//   frequency   w_h^2 - w^2 = -r . (x - I x), r = (K - w_h^2 M) P x_h,     the mode x is its own adjoint, x . M P x_h = 1
//
// z and x are of the divided solid, so both cost a factor of four times as many cells, eight in space. What that solid is off
// itself is added by the order of each cell (core/goals/corner_order.hpp). Assumed: loads that bend without end, forces at points
// of a plane or in space, are looked at elsewhere. Clamps hold what they hold on these cells.
#pragma once

#include <functional>

#include "core/goals/goal.hpp"
#include "elastic/assembly/solid.hpp"

namespace splashdown::elastic {

/// Forces on nodes of a solid [N, N/m].
template <int d>
using LoadOn = std::function<Field(const Solid<d>&)>;

/// Of equilibria u under a load: the displacement of a point along a direction [m]. Throws std::runtime_error where the tangent
/// is singular.
template <int d>
GoalError deflection_goal(const Solid<d>& solid, const Field& u, const LoadOn<d>& load, const Place<d>& place,
                          const Vec<d>& direction);

/// Of small vibrations about rest: the natural frequency of this number, 1 the lowest, rigid motions counted [Hz]. Throws
/// std::runtime_error where modes are not found, std::invalid_argument for more than the mesh has.
template <int d>
GoalError frequency_goal(const Solid<d>& solid, int number);

/// What is asked of a solid: a natural frequency, or the displacement of a point.
template <int d>
struct SolidGoal {
  std::string name;                    ///< "BODY.f1", "POINT.uy"
  int mode = 0;                        ///< number of the frequency; 0: a displacement
  Place<d> place = {};                 ///< of the point
  Vec<d> direction = Vec<d>::UnitX();  ///< that it is displaced along
  /// Of its value.
  const char* unit() const { return mode > 0 ? "Hz" : "m"; }
};

/// Whichever it is; u and the load matter for displacements.
template <int d>
GoalError goal_error(const SolidGoal<d>& goal, const Solid<d>& solid, const Field& u, const LoadOn<d>& load);

/// What an error is over the part that the divided solid shows of it, for each cell: by the exponents of corners of what moves,
/// in space of edges. Sides that are held along some axes alone count as free, orthotropic solids as isotropic ones. Where
/// several materials meet at a corner, the one of the least exponent counts for all.
template <int d>
std::vector<double> whole_errors(const Solid<d>& solid);

}  // namespace splashdown::elastic
