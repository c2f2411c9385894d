#include "rigid/forces/aero/aero.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry.hpp"

namespace splashdown::rigid {
namespace {

using Space = Eigen::Vector3d;

template <int d>
Space in_space(const Vec<d>& x) {
  Space space = Space::Zero();
  space.head<d>() = x;
  return space;
}

/// The last entry alone in 2D.
template <int d>
Space spin_of(const Twist<d>& velocity) {
  Space spin = Space::Zero();
  spin.tail<rotations<d>>() = velocity.template tail<rotations<d>>();
  return spin;
}

}  // namespace

/// What a body meets, world frame.
template <int d>
struct Aero<d>::Flow {
  Space nose, up, right, arm;  // arm: from the centre of mass to the point
  Space e = Space::Zero();     // the way the point goes through the air
  double speed = 0, attack = 0, sideslip = 0;
  double pressure_area = 0;  // q S of what is dry
  double roll_rate, pitch_rate, yaw_rate;

  double drag(const AeroSpec<d>& spec) const { return spec.drag.at(attack)[0] + spec.sideslip_drag.at(sideslip)[0]; }
  double lift(const AeroSpec<d>& spec) const { return spec.lift.at(attack)[0]; }
};

template <int d>
typename Aero<d>::Flow Aero<d>::flow(const AeroSpec<d>& spec, const BodiesAt<d>& at) const {
  const auto& [pose, velocity] = at.states[spec.body];
  Flow flow;
  flow.nose = in_space<d>(pose.linear() * spec.nose);
  flow.up = in_space<d>(pose.linear() * spec.up);
  flow.right = flow.nose.cross(flow.up);
  flow.arm = in_space<d>(pose.linear() * spec.point);
  const Space spin = spin_of<d>(velocity);
  flow.roll_rate = spin.dot(flow.nose);
  flow.pitch_rate = spin.dot(flow.right);
  flow.yaw_rate = -spin.dot(flow.up);
  Space through = in_space<d>(velocity.template head<d>()) + spin.cross(flow.arm);
  if (wind_) through -= in_space<d>(wind_->at(pose * spec.point, at.time));
  flow.speed = through.norm();
  if (!(flow.speed > 0)) return flow;
  flow.e = through / flow.speed;
  flow.attack = std::atan2(-flow.e.dot(flow.up), flow.e.dot(flow.nose));
  flow.sideslip = std::asin(std::clamp(flow.e.dot(flow.right), -1.0, 1.0));
  const double dry = at.wetted_share.empty() ? 1 : 1 - at.wetted_share[spec.body];
  flow.pressure_area = dry * 0.5 * spec.density * flow.speed * flow.speed * spec.area;
  return flow;
}

template <int d>
void Aero<d>::add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const {
  constexpr double across = 1e-9;  // nearer to the side than that, there is no direction of lift
  for (const auto& spec : specs_) {
    const Flow flow = this->flow(spec, at);
    if (!(flow.pressure_area > 0)) continue;
    const Space above = flow.right.cross(flow.e);
    const Space lift = above.norm() > across ? Space(above.normalized()) : Space(Space::Zero());
    const Space force = flow.pressure_area * (-flow.drag(spec) * flow.e + flow.lift(spec) * lift +
                                              spec.side.at(flow.sideslip)[0] * flow.e.cross(lift));
    const double per_rate = 1 / (2 * flow.speed);
    const double pitch = spec.moment.at(flow.attack)[0] + spec.pitch_damping * flow.pitch_rate * spec.length * per_rate;
    Space moment = flow.arm.cross(force) + flow.pressure_area * spec.length * pitch * flow.right;
    if constexpr (d == 3) {
      const double roll = spec.roll.at(flow.sideslip)[0] + spec.roll_damping * flow.roll_rate * spec.span * per_rate;
      const double yaw = spec.yaw.at(flow.sideslip)[0] + spec.yaw_damping * flow.yaw_rate * spec.span * per_rate;
      moment += flow.pressure_area * spec.span * (roll * flow.nose - yaw * flow.up);
    }
    wrenches[spec.body].template head<d>() += force.head<d>();
    wrenches[spec.body].template tail<rotations<d>>() += moment.tail<rotations<d>>();
  }
}

template <int d>
double Aero<d>::stable_dt(const BodiesAt<d>& at) const {
  double dt = std::numeric_limits<double>::infinity();
  for (const auto& spec : specs_) {
    const auto& body = at.specs[spec.body];
    const Flow flow = this->flow(spec, at);
    if (!(flow.pressure_area > 0) || !(body.mass > 0)) continue;
    const auto stiffness = [](const auto&... curves) { return ((2 * curves.largest() + curves.steepest()) + ...); };
    const double drag =
        flow.pressure_area / flow.speed / body.mass * stiffness(spec.drag, spec.lift, spec.side, spec.sideslip_drag);
    const double least = body.inertia.template selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
    const double arm = spec.point.norm(), longest = std::max(spec.length, spec.span);
    const double turning = flow.pressure_area *
                           (longest * (spec.moment.steepest() + spec.roll.steepest() + spec.yaw.steepest()) +
                            arm * stiffness(spec.drag, spec.lift, spec.side, spec.sideslip_drag)) /
                           least;
    const double damping =
        flow.pressure_area / (2 * flow.speed) * longest * longest *
        std::max({std::abs(spec.roll_damping), std::abs(spec.pitch_damping), std::abs(spec.yaw_damping)}) / least;
    dt = std::min(dt, 1 / (drag + damping + std::sqrt(turning)));
  }
  return dt;
}

template <int d>
std::vector<Diagnostic> Aero<d>::diagnostics(const BodiesAt<d>& at) const {
  std::vector<Diagnostic> all;
  for (const auto& spec : specs_) {
    const Flow flow = this->flow(spec, at);
    const auto& body = at.specs[spec.body].name;
    all.emplace_back(body + "_airspeed", flow.speed);
    all.emplace_back(body + "_attack", flow.attack);
    all.emplace_back(body + "_drag", flow.pressure_area * flow.drag(spec));
    all.emplace_back(body + "_lift", flow.pressure_area * flow.lift(spec));
  }
  return all;
}

template class Aero<2>;
template class Aero<3>;

}  // namespace splashdown::rigid
