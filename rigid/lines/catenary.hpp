// Elastic catenary between an anchor and a fairlead, at rest under its own weight.
//
//   x(H, V) = (H/w) [asinh(V/H) - asinh(V_a/H)] + H L/(EA)
//   z(H, V) = (1/w) [sqrt(H^2 + V^2) - sqrt(H^2 + V_a^2)] + (V^2 - V_a^2)/(2 EA w),   V_a = V - w L
//
// With a floor at the height of the anchor the length L_b = max(L - V/w, 0) lies on it: V_a = max(V - w L, 0),
//
//   x += L_b + mu w/(2 EA) [L_k^2 - L_b^2],   L_k = max(L_b - H/(mu w), 0)
//
// H, V: horizontal and vertical force on the fairlead's end of the line [N]; x, z: how far the fairlead is from the anchor
// sideways and upwards [m]; L: unstretched length, w: weight a metre under water, mu: friction of the floor, which takes tension
// on the way to the anchor. Irvine, Cable Structures (1981), sections 2.4 and 2.5; with the floor Jonkman, NREL/TP-500-41958
// (2007), equations 2-35 and 2-37. Small strain; w is taken a metre of unstretched length. x and z grow with H and V, so that
// nested bisection always ends.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace splashdown::rigid {

/// What a catenary is made from.
struct CatenarySpec {
  double length = 0;           ///< unstretched, L [m]
  double axial_stiffness = 0;  ///< EA [N]
  double weight = 0;           ///< a metre, under water, w [N/m]
  bool floor = true;           ///< the anchor stands on a floor that carries the line
  double friction = 0;         ///< mu, of the floor [-]
};

/// How the fairlead's end is pulled, and what of the line lies on the floor.
struct CatenaryEnd {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< H, V: on the line, away from the anchor and up [N]
  Eigen::Matrix2d stiffness =
      Eigen::Matrix2d::Zero();  ///< d(H, V)/d(x, z), not negative; symmetric unless there is friction [N/m]
  double on_floor = 0;          ///< L_b, unstretched [m]
  double anchor_tension = 0;    ///< [N]
};

/// x, z of a line whose end is pulled with H > 0 and V [m].
Eigen::Vector2d catenary_span(const CatenarySpec& line, double horizontal_force, double vertical_force);

/// The end of a line whose fairlead is `span` = (x, z) from its anchor, x >= 0. A line that hangs straight down onto its floor
/// has H = 0; a fairlead below the floor counts as on it.
CatenaryEnd catenary_end(const CatenarySpec& line, const Eigen::Vector2d& span);

/// Throws std::invalid_argument unless length, axial stiffness and weight are positive and friction is not negative.
void check(const CatenarySpec& line);

}  // namespace splashdown::rigid
