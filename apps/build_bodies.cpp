#include <algorithm>
#include <numbers>

#include "apps/build.hpp"
#include "apps/scene_geometry.hpp"

namespace splashdown::apps {
namespace {

using rigid::Isometry;
using rigid::Twist;
using rigid::Vec;

constexpr double radians = std::numbers::pi / 180;

/// Body frame (origin: centre of mass) to world, when the shape's reference point is at `position`.
Isometry<2> body_pose(const Point& position, double pitch_deg, const Vec<2>& centre) {
  return shape_pose(position, pitch_deg) * Eigen::Translation2d(centre);
}

Waypoint between(const Waypoint& a, const Waypoint& b, double time) {
  const double share = (time - a.time) / (b.time - a.time);
  return {time, a.position + share * (b.position - a.position),
          a.pitch_deg + share * (b.pitch_deg - a.pitch_deg)};
}

/// Piecewise linear between the waypoints, at rest after the last.
Waypoint on_path(const std::vector<Waypoint>& path, double time) {
  const auto next =
      std::find_if(path.begin(), path.end(), [&](const Waypoint& point) { return point.time > time; });
  if (next == path.begin()) return path.front();
  return next == path.end() ? path.back() : between(*(next - 1), *next, time);
}

std::function<Isometry<2>(double)> pose_along(const std::vector<Waypoint>& path, const Vec<2>& centre) {
  return [path, centre](double time) {
    const auto point = on_path(path, time);
    return body_pose(point.position, point.pitch_deg, centre);
  };
}

std::function<Isometry<2>(double)> steady_motion(const Isometry<2>& start, const Twist<2>& velocity) {
  return [start, velocity](double time) {
    Isometry<2> pose = start;
    pose.pretranslate(velocity.head<2>() * time);
    pose.rotate(Eigen::Rotation2Dd(velocity[2] * time));
    return pose;
  };
}

/// Of the centre of mass on the path's first leg, at its beginning.
Twist<2> first_velocity(const std::vector<Waypoint>& path, const Vec<2>& centre) {
  const auto& a = path[0];
  const auto& b = path[1];
  const double seconds = b.time - a.time, spin = (b.pitch_deg - a.pitch_deg) * radians / seconds;
  const Vec<2> arm = shape_pose(a.position, a.pitch_deg).linear() * centre;
  const Vec<2> velocity = planar(b.position - a.position) / seconds + spin * Vec<2>(-arm.y(), arm.x());
  return {velocity.x(), velocity.y(), spin};
}

rigid::Motion motion_of(Motion motion) {
  switch (motion) {
    case Motion::fixed:
      return rigid::Motion::fixed;
    case Motion::prescribed:
      return rigid::Motion::prescribed;
    case Motion::free:
      break;
  }
  return rigid::Motion::free;
}

}  // namespace

rigid::BodySpec<2> body_spec(const Body& body) {
  const auto properties = mass_properties(body);
  rigid::BodySpec<2> spec;
  spec.name = body.name;
  spec.surface = rigid::centred<2>(shape_of(body.shape).surface, properties.centre);
  spec.mass = properties.mass;
  spec.inertia = properties.inertia;
  spec.motion = motion_of(body.motion);
  const char* const names[] = {"x", "y", "rotation"};
  for (std::size_t i = 0; i < spec.free.size(); ++i)
    spec.free[i] = std::find(body.free.begin(), body.free.end(), names[i]) != body.free.end();
  spec.pose = body_pose(body.position, body.pitch_deg, properties.centre);
  spec.velocity << body.velocity.x(), body.velocity.y(), body.spin_deg * radians;
  if (body.motion == Motion::prescribed) {
    if (!body.path.empty()) spec.velocity = first_velocity(body.path, properties.centre);
    spec.path = body.path.empty() ? steady_motion(spec.pose, spec.velocity)
                                  : pose_along(body.path, properties.centre);
  }
  return spec;
}

std::vector<rigid::JointSpec> joint_specs(const Scene& scene) {
  std::vector<rigid::JointSpec> specs;
  for (const auto& joint : scene.joints) {
    const auto type = joint.type == "slider" ? rigid::JointType::slider
                      : joint.type == "weld" ? rigid::JointType::weld
                                             : rigid::JointType::hinge;
    // A weld has no place of its own; the body's reference point is as good as any.
    const Point point = joint.type == "hinge" ? joint.point : scene.bodies[joint.body].position;
    specs.push_back({type, joint.body, joint.other, point, joint.axis.normalized()});
  }
  return specs;
}

std::optional<rigid::ContactSpec<2>> contact_spec(const Scene& scene) {
  if (!scene.contact) return {};
  rigid::ContactSpec<2> spec;
  if (!scene.tank) return spec;
  const Vec<2> low = planar(scene.tank->min), high = planar(scene.tank->max);
  spec.planes = {{low, Vec<2>::UnitX()}, {low, Vec<2>::UnitY()}, {high, -Vec<2>::UnitX()}, {high, -Vec<2>::UnitY()}};
  return spec;
}

std::vector<std::unique_ptr<rigid::Force<2>>> body_forces(const Scene& scene) {
  std::vector<std::unique_ptr<rigid::Force<2>>> forces;
  if (scene.gravity)
    forces.push_back(std::make_unique<rigid::Gravity<2>>(planar(scene.gravity->acceleration)));
  return forces;
}

}  // namespace splashdown::apps
