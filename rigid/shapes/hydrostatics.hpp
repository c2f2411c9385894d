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
#include <span>
#include <vector>

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
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass, double density,
                                    double water_level);

/// Horizontal direction in which a heeled body rises [rad]: to the right in the plane, x and y in space.
template <int d>
using Slope = Eigen::Matrix<double, d - 1, 1>;

/// GM against a tilt that lifts the side that `direction` (of unit length) points to: n . I_w n / V + KB - KG [m].
/// For roll the direction across the body, for pitch the one along it.
template <int d>
double metacentric_height(const Floating<d>& floating, const Slope<d>& direction);

/// Where a body floats when it may heel and trim: the stable attitude that its righting moments lead to from the given
/// one (in the plane counter-clockwise if that one is an unstable balance). Found by descent of the height of the
/// centre of mass over that of buoyancy, which is the energy over the weight. Yaw stays as it is.
template <int d>
std::optional<Floating<d>> floating_stable(const Surface<d>& surface, const Isometry<d>& pose, double mass,
                                           double density, double water_level);

/// A point of a curve of static stability.
struct Heeled {
  double heel = 0;   ///< [rad]
  double lever = 0;  ///< GZ, of the moment that rights the body over its weight [m]
  Floating<3> floating;
};

/// Righting levers of a body turned from rest about a horizontal axis (unit length, by the right hand) to each of the
/// rising `heels` [rad], free to sink and to trim: it turns about the horizontal axis across until that moment vanishes.
std::vector<Heeled> righting_levers(const Surface<3>& surface, const Floating<3>& rest, double mass, double density,
                                    double water_level, const Slope<3>& axis, std::span<const double> heels);

}  // namespace splashdown::rigid
