// A band and a grade for every peak, from what the steps around it say (evidence.hpp).
//
//   band = sqrt(mesh^2 + step^2 + sideways^2), of pressures + repair^2: independent errors
//
//   mesh      g s(n) + (1 - g) r(n), n elements on half of the wetted width, g the share of it that is growing
//             s  load of a hull that enters: in the plane 5 % at 25 elements, in space 13 % at 17, of first order
//             r  load of a hull whose wetted part stays: 3 % at 17 elements, of first order
//             A load that mostly carries weight is wrong by as little as its inertial part: times |m a| / load. A pressure is
//             local: times 1 + 2/(1 + n_p), with n_p elements on half of the patch, 3 at a point
//   step      of filtered peaks in the filtered channel
//   sampling  of filtered peaks: what means over the steps take, of the highest frequency or by their second differences, the less (filters.hpp)
//   sideways  symmetric scenes
//   repair    what pressures lack; a raw peak of a load that is impulse by half or more goes as 1/dt and has no value
//
// Where s, r and the factor of pressures come from: docs/guide.md, "The band". First order is less than what is measured
// for most hulls: a band that promises too much is worse than one that promises too little.
//
//   resolved    band <= 5 %, the band of the verdict's energy (verdict.hpp)
//   doubtful    band <= 10 %: elements of half the size bring it to 5 %
//   unresolved  above, or no number: ten times the value is none
//
// A peak of a free body's load that still rises when the record ends is unresolved, whatever its band (missing.hpp).
//
// Numbers that are not graded: peaks of what moves as prescribed or never touched water, and accelerations below 2 % of g,
// which are of a body at rest.
#pragma once

#include "apps/statistics/filters.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

inline constexpr double resolved_band = 0.05, doubtful_band = 0.10;

/// Share of the error of the mesh in a load, see above.
double mesh_band(int dimension, const Evidence& evidence);
Grade grade_of_band(double band);

/// Turns the evidence of a summary into bands and grades. `bodies.NAME.of_water` must be filled: numbers are no better than the water.
void grade_numbers(Summary& summary);

/// The numbers that a body's verdict goes by, with their names: accelerations and loads of CFC 60, raw where the record is too
/// short for that class, of the body and of its instruments, and means over patches.
struct Headline {
  std::string name, value;   ///< with the filter: "peak force, CFC 60"
  std::string what, filter;  ///< apart: "peak force", "CFC 60"; pressures have no filter
  const NumberGrade* grade = nullptr;
  bool is_impulse = false;  ///< a raw peak or a pressure where half of the load or more is: no mesh gives it a value
};
std::vector<Headline> headlines(const Summary& summary, const std::string& body);

}  // namespace splashdown::apps
