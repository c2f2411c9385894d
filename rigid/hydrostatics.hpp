// Archimedes: what a body displaces in still water, where it floats and how stably.
//
//   V = int_(below) dV,   m = rho V,   centre of buoyancy above centre of mass,   GM = KB + I_w / V - KG
//
// The last coordinate points up. Surfaces are in the body frame (origin = centre of mass), closed, with
// outward normals, and not necessarily convex. Everything is exact for the polygon or triangle mesh:
// cones over the clipped facets from a point of the water plane give the volume, the clipped facets'
// vertical projections the waterline. Two-dimensional values are per metre of depth.
#pragma once

#include <optional>

#include "rigid/types.hpp"

namespace splashdown::rigid {

template <int d>
struct Submerged {
  double volume = 0;               ///< [m^2, m^3]
  Vec<d> centre = Vec<d>::Zero();  ///< of buoyancy, world frame; meaningless if volume = 0
  double waterline = 0;            ///< breadth (2D) [m] or area (3D) [m^2] of the water plane inside the body
  /// Second moments of the water plane about its centroid [m^3, m^4].
  Eigen::Matrix<double, d - 1, d - 1> waterline_moment = Eigen::Matrix<double, d - 1, d - 1>::Zero();
};

template <int d>
Submerged<d> submerged(const Surface<d>& surface, const Isometry<d>& pose, double water_level);

template <int d>
struct Floating {
  Isometry<d> pose = Isometry<d>::Identity();
  Submerged<d> submerged;
  double draft = 0;               ///< lowest point below the water level [m]
  double metacentric_height = 0;  ///< GM, about the least stable axis; negative: unstable [m]
};

/// Where the body floats if it keeps its orientation; nothing if it sinks. pose keeps the horizontal place.
template <int d>
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass,
                                    double density, double water_level);

/// Where a planar body floats when it may heel: the stable attitude that its righting moment leads to
/// from the given one (counter-clockwise if that one is an unstable balance).
std::optional<Floating<2>> floating_stable(const Surface<2>& surface, const Isometry<2>& pose, double mass,
                                           double density, double water_level);

}  // namespace splashdown::rigid
