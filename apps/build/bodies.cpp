#include <algorithm>

#include "apps/build/build.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/joint_kinds.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {
namespace {

using rigid::Isometry;
using rigid::Rotation;
using rigid::Twist;
using rigid::Vec;

/// Body frame (origin: centre of mass) to world, when the shape's reference point is at `position`.
template <int d>
Isometry<d> body_pose(const Point& position, const Attitude& attitude, const Vec<d>& centre) {
  return shape_pose<d>(position, attitude) * Eigen::Translation<double, d>(centre);
}

Attitude between(const Attitude& a, const Attitude& b, double share) {
  return {.heading_deg = a.heading_deg + share * (b.heading_deg - a.heading_deg),
          .pitch_deg = a.pitch_deg + share * (b.pitch_deg - a.pitch_deg),
          .roll_deg = a.roll_deg + share * (b.roll_deg - a.roll_deg)};
}

Waypoint between(const Waypoint& a, const Waypoint& b, double time) {
  const double share = (time - a.time) / (b.time - a.time);
  return {time, a.position + share * (b.position - a.position), between(a.attitude, b.attitude, share)};
}

/// Piecewise linear between the waypoints, at rest after the last.
Waypoint on_path(const std::vector<Waypoint>& path, double time) {
  const auto next = std::ranges::upper_bound(path, time, {}, &Waypoint::time);
  if (next == path.begin()) return path.front();
  return next == path.end() ? path.back() : between(*(next - 1), *next, time);
}

template <int d>
std::function<Isometry<d>(double)> pose_along(const std::vector<Waypoint>& path, const Vec<d>& centre) {
  return [path, centre](double time) {
    const auto point = on_path(path, time);
    return body_pose<d>(point.position, point.attitude, centre);
  };
}

template <int d>
std::function<Isometry<d>(double)> pose_of(const Oscillation& swing, const Vec<d>& centre) {
  return [swing, centre](double time) {
    const auto point = swing.at(time);
    return body_pose<d>(point.position, point.attitude, centre);
  };
}

template <int d>
std::function<Isometry<d>(double)> steady_motion(const Isometry<d>& start, const Twist<d>& velocity) {
  return [start, velocity](double time) {
    const Rotation<d> angle = velocity.template tail<rigid::rotations<d>>() * time;
    Isometry<d> pose = start;
    pose.linear() = splashdown::rotation(angle) * start.linear();
    pose.pretranslate(velocity.template head<d>() * time);
    return pose;
  };
}

/// Of the centre of mass, where the reference point and the attitude change at such rates.
template <int d>
Twist<d> twist_of(const Waypoint& at, const Waypoint& rate, const Vec<d>& centre) {
  const Rotation<d> spin = angular_velocity<d>(at.attitude, rate.attitude);
  const Eigen::Vector3d arm = in_space<d>(rotation<d>(at.attitude) * centre);
  Twist<d> velocity;
  velocity << vec<d>(rate.position) + rotation_in_space<d>(spin).cross(arm).template head<d>(), spin;
  return velocity;
}

/// On the path's first leg, at its beginning.
template <int d>
Twist<d> first_velocity(const std::vector<Waypoint>& path, const Vec<d>& centre) {
  const auto& a = path[0];
  const auto& b = path[1];
  const double seconds = b.time - a.time;
  const Attitude rate{.heading_deg = (b.attitude.heading_deg - a.attitude.heading_deg) / seconds,
                      .pitch_deg = (b.attitude.pitch_deg - a.attitude.pitch_deg) / seconds,
                      .roll_deg = (b.attitude.roll_deg - a.attitude.roll_deg) / seconds};
  return twist_of<d>(a, {0, (b.position - a.position) / seconds, rate}, centre);
}

BodyMotion motion_of(Motion motion) {
  switch (motion) {
    case Motion::fixed:
      return BodyMotion::fixed;
    case Motion::prescribed:
      return BodyMotion::prescribed;
    case Motion::free:
      break;
  }
  return BodyMotion::free;
}

}  // namespace

template <int d>
rigid::BodySpec<d> body_spec(const Body& body) {
  const auto properties = mass_properties<d>(body);
  rigid::BodySpec<d> spec;
  spec.name = body.name;
  spec.surface = rigid::centred<d>(shape_of<d>(body.shape).surface, properties.centre);
  spec.mass = properties.mass;
  spec.inertia = properties.inertia;
  spec.motion = motion_of(body.motion);
  spec.release = body.release;
  const auto names = freedom_names(d);
  for (std::size_t i = 0; i < spec.free.size(); ++i)
    spec.free[i] = std::find(body.free.begin(), body.free.end(), names[i]) != body.free.end();
  spec.pose = body_pose<d>(body.position, body.attitude, properties.centre);
  spec.velocity << vec<d>(body.velocity), body.spin_deg.tail<rigid::rotations<d>>() * radians;
  if (body.oscillation) {
    spec.velocity = twist_of<d>(body.oscillation->at(0), body.oscillation->rate_at(0), properties.centre);
    spec.path = pose_of<d>(*body.oscillation, properties.centre);
  } else if (body.motion == Motion::prescribed) {
    if (!body.path.empty()) spec.velocity = first_velocity<d>(body.path, properties.centre);
    spec.path =
        body.path.empty() ? steady_motion<d>(spec.pose, spec.velocity) : pose_along<d>(body.path, properties.centre);
  }
  return spec;
}

std::vector<rigid::JointSpec> joint_specs(const Scene& scene) {
  std::vector<rigid::JointSpec> specs;
  for (const auto& joint : scene.joints) {
    const auto& kind = kind_of(joint);
    // A weld has no place of its own; the body's reference point is as good as any.
    const Point point = kind.turns ? joint.point : scene.bodies[joint.body].position;
    rigid::JointSpec spec{kind.type, joint.body, joint.other, point, joint.axis.normalized()};
    const double unit = kind.turns ? radians : 1;
    if (!joint.limits.empty()) spec.stops = {unit * joint.limits[0], unit * joint.limits[1]};
    if (joint.stiffness > 0 || joint.damping > 0)
      spec.spring = rigid::Spring{joint.stiffness, joint.damping, unit * joint.rest};
    specs.push_back(spec);
  }
  return specs;
}

template <int d>
std::optional<rigid::ContactSpec<d>> contact_spec(const Scene& scene) {
  if (!scene.contact) return {};
  rigid::ContactSpec<d> spec;
  spec.friction = scene.contact->friction;
  spec.restitution = scene.contact->restitution;
  if (!scene.tank) return spec;
  for (int k = 0; k < d; ++k) spec.planes.push_back({vec<d>(scene.tank->min), Vec<d>::Unit(k)});
  for (int k = 0; k < d; ++k) spec.planes.push_back({vec<d>(scene.tank->max), -Vec<d>::Unit(k)});
  return spec;
}

template rigid::BodySpec<2> body_spec<2>(const Body&);
template rigid::BodySpec<3> body_spec<3>(const Body&);
template std::optional<rigid::ContactSpec<2>> contact_spec<2>(const Scene&);
template std::optional<rigid::ContactSpec<3>> contact_spec<3>(const Scene&);

}  // namespace splashdown::apps
