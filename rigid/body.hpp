// Bodies as their room names them, their mass properties, and what may be moved.
#pragma once

#include "core/bodies_view.hpp"
#include "rigid/types.hpp"

namespace splashdown::rigid {

using splashdown::BodySpec;
using splashdown::BodyState;

/// Mass, centre of mass and inertia about it. 2D values are per metre of depth (kg/m, kg m).
template <int d>
struct MassProperties {
  double mass = 0;                          ///< [kg] or [kg/m]
  Vec<d> centre = Vec<d>::Zero();           ///< centre of mass in the shape's own frame [m]
  Inertia<d> inertia = Inertia<d>::Zero();  ///< about the centre of mass, body axes [kg m^2]
};

/// By which a turn of one radian moves the farthest point of a body [m]; 1 for one without a surface.
template <int d>
double reach(const BodySpec<d>& spec);

/// |V| + |w| r of a body with reach r: no point of it is faster [m/s].
template <int d>
double farthest_speed(const Twist<d>& velocity, double reach) {
  return velocity.template head<d>().norm() + reach * velocity.template tail<rotations<d>>().norm();
}

/// Throws std::invalid_argument naming body, rule and value unless the body can be moved as specified.
template <int d>
void check(const BodySpec<d>& spec);

}  // namespace splashdown::rigid
