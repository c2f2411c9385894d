// Element sizes for a scene that names none, by the rules of docs/guide.md, "Choose sizes and steps".
//
//   entering hull   c/50 in the plane, c/33 in space, at most; later elements grow with the wetted width (wetted_fraction). In
//      space half as many do where the root of the jet has smaller ones (hollow)
//      c  half of the wetted width at the largest load, at most half of the hull's breadth, at least that of a flat bottom.
//         A free body loads most when its added mass is a fifth of its mass (wedge, Ma ~ d^2, F ~ d/(1 + Ma/m)^3), in space
//         an eighth (round bottom, Ma ~ d^1.5): rho pi/2 c^2 = m/5, 4/3 rho c^3 = m/8 (Wagner 1932). Prescribed motion: c at the
//         end of the run
//   wet hull        half of its breadth over 30, in space over 14: added mass within 1 %; no hull more than the surface
//   root of a jet   in the plane with prescribed motion, where the jet is thinner than an element of the hull: a fifth of the
//                   root's radius, down to half of the jet's thickness at c, at least an eighth of the hull's
//   free surface    a fifth of the hull's breadth; a twentieth, forty elements a wave of two breadths, where the run lasts
//                   for half a period of heave or the hull floats from the start; without a hull forty a wave that is
//                   given, else a thirtieth of the liquid's least extent
//   far             the hull's breadth, at most an eighth of the liquid's least extent
//   growth          0.2 in the plane, 0.25 in space
//
// Every length follows from lengths of the scene, masses and ratios of speeds to sqrt(g L): a scene ten times as large, with
// Froude's speeds and times, has sizes ten times as large. Sizes are rounded to two digits.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// A size that the scene does not name.
struct ChosenSize {
  std::string table;      ///< "fluid.size" or "body"
  std::size_t index = 0;  ///< of the body
  std::string key;
  double value = 0;
  std::string unit;  ///< as it is printed after the value
  std::string why;
};

/// Of all sizes, in the order of the scene's tables.
template <int d>
std::vector<ChosenSize> size_rules(const Scene& scene);

/// What of a scene's own sizes is coarser than the rules, a sentence each.
template <int d>
std::vector<std::string> sizes_against_rules(const Scene& scene);

}  // namespace splashdown::apps
