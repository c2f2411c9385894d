// Where bodies come to rest on still water: the minimum of potential energy among the places that joints, held freedoms,
// stops and contacts leave.
//
//   E = sum over bodies of  m g z + rho g int_(below) (z_w - z) dV,   over springs of  k (q - q_0)^2 / 2
//
// Found from the pose at t = 0 by descent in short steps, so that it is the minimum of the basin in which a damped motion
// stays: each step is Newton's for E on the linearised conditions (sequential quadratic programming, Nocedal and Wright 2006,
// chapter 18), with the curvature of joints, made convex, and a twentieth of a body long at most; joints are then met again to
// round-off. At an unstable balance it turns off counter-clockwise. Friction is left out, the water level stays as it is.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "rigid/body.hpp"
#include "rigid/contact/contacts.hpp"
#include "rigid/joint.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::rigid {

/// What may move together. Bodies that are held or prescribed stay where they are at t = 0.
template <int d>
struct Mechanism {
  std::vector<BodySpec<d>> bodies;              ///< at t = 0
  std::vector<JointSpec> joints = {};           ///< between them, or to the world
  std::optional<ContactSpec<d>> contacts = {};  ///< absent: nothing touches
  std::vector<Hollow> hollows = {};             ///< of the bodies; absent: all dry
};

/// Water at rest, gravity along the last axis, downward.
struct StillWater {
  double density = 1000;  ///< [kg/m^3]
  double gravity = 9.81;  ///< [m/s^2]
  double level = 0;       ///< [m]
};

/// A body where it has come to rest.
template <int d>
struct BodyAtRest {
  Isometry<d> pose = Isometry<d>::Identity();  ///< body frame to world
  Submerged<d> submerged;                      ///< what it displaces there
  double draft = 0;                            ///< lowest point below the water level; negative: dry [m]
  double freeboard = std::numeric_limits<double>::infinity();  ///< as in Floating [m]
  Hollow hollow = Hollow::dry;                                 ///< what is in its hollows
  bool touches = false;                                        ///< another body or a plane
  bool sinks = false;                                          ///< goes down without end
};

/// Where all have come to rest.
template <int d>
struct Rest {
  std::vector<BodyAtRest<d>> bodies;  ///< in the order of the mechanism
  double energy = 0;                  ///< [J], 2D: per metre
  std::vector<double> moved;          ///< coordinates of the joints [m, rad]
  bool found = false;                 ///< the descent ended
};

/// The minimum of E that descent reaches from the poses at t = 0; Rest::found says whether it ended.
template <int d>
Rest<d> at_rest(const Mechanism<d>& mechanism, const StillWater& water);

}  // namespace splashdown::rigid
