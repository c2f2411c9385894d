// What a run is worth: measurements become reasons, the worst of which is the grade.
//
//   gain of energy over what there was to give or to take, kinetic energy below zero, change of volume over the volume of
//   the hulls or of all water, whichever is less:    > 5 %: unphysical,  > 2 %: doubtful
//   a run that could not go on: unphysical
//   headline numbers of bodies whose band is wide (grades.hpp): doubtful, unresolved
//
// The limits are those of engineering error bands: a load that is wanted within 5 % cannot come from water whose energy is
// wrong by more. A change of volume has no innocent cause: liquid has no inlet and no outlet, and drops count. A body is
// graded by the reasons that concern it. A new measurement is a new row of the table in verdict.cpp.
#pragma once

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

inline constexpr double unphysical_above = 0.05, doubtful_above = 0.02;

/// Fills the verdicts of the run and of its bodies from what else the summary holds.
void judge(Summary& summary);

}  // namespace splashdown::apps
