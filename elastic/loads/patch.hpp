// Tractions on a patch of a solid's boundary, and how they go in time. A patch is what a function says of places at rest;
// tractions are per area at rest and keep their direction (dead loads). Facets are integrated in parts, so that a patch may end
// within one.
#pragma once

#include <functional>

#include "elastic/assembly/solid.hpp"

namespace splashdown::elastic {

/// Whether a place at rest, world frame at t = 0, is on the patch.
template <int d>
using OnPatch = std::function<bool(const Vec<d>&)>;

/// Length (2D) or area of a patch at rest [m, m^2].
template <int d>
double patch_area(const SolidMesh<d>& mesh, const OnPatch<d>& on);

/// Forces on nodes of a traction, a function of the place and of the outward normal at rest [N/m; N].
template <int d>
Field patch_force(const SolidMesh<d>& mesh, const OnPatch<d>& on,
                  const std::function<Vec<d>(const Vec<d>&, const Vec<d>&)>& traction);

/// Forces on nodes of a disc (2D: a strip) of unit stretch that is bonded to the boundary: 1 N per metre of its rim (2D: 1 N/m
/// at each end) along the boundary away from its middle. Shear is passed on at the rim alone, which is the limit of a thin, stiff
/// bond (pin force; Crawley, de Luis 1987); it acts over the outer tenth of the radius, on the side of the boundary that the
/// middle is on. Zero where no boundary is.
template <int d>
Field stretch_force(const SolidMesh<d>& mesh, const Vec<d>& centre, double radius);

/// sin(w t) (1 - cos(w t/n))/2 of n cycles from `start` on: a tone in Hann's window, w = 2 pi frequency; zero before and after.
struct ToneBurst {
  double frequency = 0;  ///< [Hz]
  double cycles = 5;     ///< n
  double start = 0;      ///< [s]
  /// At a time [-].
  double at(double t) const;
};

}  // namespace splashdown::elastic
