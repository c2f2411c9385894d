// What a rigid body is: surface, mass properties, freedom and motion.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// Mass, centre of mass and inertia about it. 2D values are per metre of depth (kg/m, kg m).
template <int d>
struct MassProperties {
  double mass = 0;                          ///< [kg] or [kg/m]
  Vec<d> centre = Vec<d>::Zero();           ///< centre of mass in the shape's own frame [m]
  Inertia<d> inertia = Inertia<d>::Zero();  ///< about the centre of mass, body axes [kg m^2]
};

enum class Motion { free, fixed, prescribed };

template <int d>
struct BodySpec {
  std::string name;
  Surface<d> surface;  ///< in the body frame, whose origin is the centre of mass
  double mass = 0;
  Inertia<d> inertia = Inertia<d>::Identity();
  Motion motion = Motion::free;
  std::array<bool, freedoms<d>> free{};        ///< which of (V, w) may change, world axes; used when motion = free
  Isometry<d> pose = Isometry<d>::Identity();  ///< body frame to world at t = 0
  Twist<d> velocity = Twist<d>::Zero();        ///< at t = 0
  /// Pose at time t for motion = prescribed [world frame].
  std::function<Isometry<d>(double)> path;
};

template <int d>
struct BodyState {
  Isometry<d> pose;   ///< at t_n, body frame to world
  Twist<d> velocity;  ///< at t_{n-1/2} (at t_0 for the first step)
};

/// By which a turn of one radian moves the farthest point of a body [m]; 1 for one without a surface.
template <int d>
double reach(const BodySpec<d>& spec);

/// Throws std::invalid_argument naming body, rule and value unless the body can be moved as specified.
template <int d>
void check(const BodySpec<d>& spec);

}  // namespace splashdown::rigid
