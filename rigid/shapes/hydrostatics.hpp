// Archimedes: what a body displaces in still water, where it floats and how stably.
//
//   V = int_(below) dV,   m = rho V,   centre of buoyancy above centre of mass,   GM = KB + I_w / V - KG
//
// The last coordinate points up. Surfaces are in the body frame (origin = centre of mass), closed, with
// outward normals, and not necessarily convex. Everything is exact for the polygon or triangle mesh:
// cones over the clipped facets from a point of the water plane give the volume, the clipped facets'
// vertical projections the waterline. Two-dimensional values are per metre of depth.
// A hollow that is open above, the inside of a boat, is dry until water comes over its rim, and displaces with the hull; then
// it is flooded for good. Hollows that are under water in the given pose are flooded.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// What a body displaces in still water; 2D: per metre of depth.
template <int d>
struct Submerged {
  double volume = 0;               ///< [m^2, m^3]
  Vec<d> centre = Vec<d>::Zero();  ///< of buoyancy, world frame; meaningless if volume = 0
  double waterline = 0;            ///< breadth (2D) [m] or area (3D) [m^2] of the water plane inside the body
  /// Centroid of the water plane over the ground, beside the centre of mass [m].
  Eigen::Matrix<double, d - 1, 1> waterline_centre = Eigen::Matrix<double, d - 1, 1>::Zero();
  /// Second moments of the water plane about its centroid [m^3, m^4].
  Eigen::Matrix<double, d - 1, d - 1> waterline_moment = Eigen::Matrix<double, d - 1, d - 1>::Zero();
};

/// What is in the hollows of a hull before water comes over their rims.
enum class Hollow { dry, flooded };

/// Volume, centre of buoyancy and waterline of a body in the given pose. `water_level` [m]: the last coordinate of the
/// water plane, world frame. Exact for the facets. O(facets).
template <int d>
Submerged<d> submerged(const Surface<d>& surface, const Isometry<d>& pose, double water_level,
                       Hollow hollow = Hollow::dry);

/// The lowest points of all hollows of a body that open upward, world frame: whether there is liquid in them decides about
/// Hollow.
template <int d>
std::vector<Vec<d>> hollow_bottoms(const Surface<d>& surface, const Isometry<d>& pose);

/// A body that floats.
template <int d>
struct Floating {
  Isometry<d> pose = Isometry<d>::Identity();  ///< body frame to world
  Submerged<d> submerged;                      ///< what it displaces
  double draft = 0;                            ///< lowest point below the water level [m]
  double metacentric_height = 0;               ///< GM, about the least stable axis; negative: unstable [m]
  /// Height of the lowest rim that keeps water out of a hollow, over the water [m]; infinite without such a hollow.
  double freeboard = std::numeric_limits<double>::infinity();
  Hollow hollow = Hollow::dry;  ///< flooded: water came over a rim on the way, or was inside before
};

/// Where the body floats if it keeps its orientation and comes down on the water; nothing if it sinks. pose keeps the
/// horizontal place.
template <int d>
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass, double density,
                                    double water_level, Hollow hollow = Hollow::dry);

/// Horizontal direction in which a heeled body rises [rad]: to the right in the plane, x and y in space.
template <int d>
using Slope = Eigen::Matrix<double, d - 1, 1>;

/// GM against a tilt that lifts the side that `direction` (of unit length) points to: n . I_w n / V + KB - KG [m].
/// For roll the direction across the body, for pitch the one along it.
template <int d>
double metacentric_height(const Floating<d>& floating, const Slope<d>& direction);

/// The horizontal direction in which the nose (x axis of the body) points, that of the world's x if it points up.
Slope<3> length_axis(const Floating<3>& floating);

/// Where a body floats when it may heel and trim: the stable attitude that its righting moments lead to from the given
/// one (in the plane counter-clockwise if that one is an unstable balance). Found by descent of the height of the
/// centre of mass over that of buoyancy, which is the energy over the weight. Yaw stays as it is.
template <int d>
std::optional<Floating<d>> floating_stable(const Surface<d>& surface, const Isometry<d>& pose, double mass,
                                           double density, double water_level, Hollow hollow = Hollow::dry);

/// A point of a curve of static stability.
struct Heeled {
  double heel = 0;         ///< phi [rad]
  double lever = 0;        ///< GZ = dE/dphi / (m g) along the curve [m]
  double trim = 0;         ///< tau beyond that at rest [rad], the side that the axis points to up
  double trim_height = 0;  ///< GM in trim [m]; negative: balanced in trim, but not stably
  bool jumped = false;     ///< the balance in trim that the curve followed ended before; this is the next one downhill
  Floating<3> floating;    ///< the body in this attitude
};

/// Righting levers of a body turned from rest, R = R_trim(tau) R_heel(phi) R_rest: heeled about a horizontal axis (unit
/// length, by the right hand) to each of the rising `heels` [rad], free to sink and to trim about the horizontal axis across.
/// The balance in trim, dE/dtau = 0, is followed from that at rest by continuation, stable or not: a body with a symmetry
/// keeps it. Where water comes over the rim of a hollow, or the body stands on end, the curve ends with a point there.
std::vector<Heeled> righting_levers(const Surface<3>& surface, const Floating<3>& rest, double mass, double density,
                                    double water_level, const Slope<3>& axis, std::span<const double> heels);

}  // namespace splashdown::rigid
