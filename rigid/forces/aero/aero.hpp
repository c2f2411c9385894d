// Loads of the air on bodies, by coefficients.
//
//   F = q S (-C_D e + C_L l + C_Y s),   M = r x F + q S (b C_l e_x + c C_m e_y + b C_n e_z),   q = rho V^2/2
//
// V e: velocity of a point of the body against the air; l, s: across it, lift in the plane of nose and up, side force to the
// right. e_x to the nose, e_y to the right, e_z down; r from the centre of mass to the point. Angle of attack
// atan2(V_z, V_x), sideslip asin(V_y/V); C_D, C_L, C_m are curves over the first, C_Y, C_l, C_n and an addition to C_D over the
// second. Damping: C_m += C_mq (q c/2V) and so on, with the body's rates p, q, r (Etkin and Reid 1996, chapter 4). The share of
// the hull that is dry scales all. In 2D S is per metre of depth, and there is no sideslip. Taken at the velocity of t_n: second
// order.
#pragma once

#include <optional>

#include "rigid/forces/curve.hpp"
#include "rigid/forces/force.hpp"
#include "rigid/forces/wind/wind.hpp"

namespace splashdown::rigid {

/// Of one body.
template <int d>
struct AeroSpec {
  std::size_t body = 0;             ///< among all
  double density = 1.225;           ///< of the air [kg/m^3]
  double area = 0;                  ///< S [m^2; 2D: m]
  double length = 1;                ///< c [m]
  double span = 1;                  ///< b [m]
  Vec<d> nose = Vec<d>::Unit(0);    ///< forward, body frame, unit
  Vec<d> up = Vec<d>::Unit(d - 1);  ///< across the nose, body frame, unit
  Vec<d> point = Vec<d>::Zero();    ///< r, body frame [m]
  Curve<1> drag = {};               ///< C_D over the angle of attack [rad]
  Curve<1> lift = {};               ///< C_L, the same
  Curve<1> moment = {};             ///< C_m, the same
  Curve<1> side = {};               ///< C_Y over sideslip [rad]
  Curve<1> roll = {};               ///< C_l, the same
  Curve<1> yaw = {};                ///< C_n, the same
  Curve<1> sideslip_drag = {};      ///< added to C_D, the same
  double roll_damping = 0;          ///< C_lp
  double pitch_damping = 0;         ///< C_mq
  double yaw_damping = 0;           ///< C_nr
};

/// Lift, drag and moments of the air that moves as the wind does.
template <int d>
class Aero final : public Force<d> {
 public:
  /// One spec for each body that the air acts on; without a wind the air is at rest.
  Aero(std::vector<AeroSpec<d>> specs, std::optional<Wind<d>> wind)
      : specs_(std::move(specs)), wind_(std::move(wind)) {}
  std::string name() const override { return "aero"; }
  bool is_of_velocity() const override { return true; }
  void add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const override;
  /// Half of what the explicit midpoint rule bears, of drag, of damping and of the moment that turns the body into the wind.
  double stable_dt(const BodiesAt<d>& at) const override;
  /// NAME_airspeed [m/s], NAME_attack [rad], NAME_drag and NAME_lift [N, N/m] of each body.
  std::vector<Diagnostic> diagnostics(const BodiesAt<d>& at) const override;

 private:
  struct Flow;
  Flow flow(const AeroSpec<d>& spec, const BodiesAt<d>& at) const;

  std::vector<AeroSpec<d>> specs_;
  std::optional<Wind<d>> wind_;
};

extern template class Aero<2>;
extern template class Aero<3>;

}  // namespace splashdown::rigid
