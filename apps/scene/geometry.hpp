// Surfaces and mass properties of what a scene describes.
//
// Shape frame: as drawn, origin at the shape's reference point. Body frame: origin at the centre of mass.
// World frame of a shape at t = 0: position + R(attitude) x. Impossible shapes throw std::invalid_argument.
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <optional>
#include <string>

#include "apps/scene/scene.hpp"
#include "rigid/shapes/shapes.hpp"

namespace splashdown::apps {

inline constexpr double radians = std::numbers::pi / 180;

template <int d>
rigid::Vec<d> vec(const Point& point) {
  return point.head<d>();
}

/// Three entries, zero beyond the last axis.
template <int d>
Eigen::Vector3d in_space(const rigid::Vec<d>& x) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  vector.head<d>() = x;
  return vector;
}
/// Angles that are small or about one axis, their rates or moments, as a vector; in two dimensions its last entry alone.
template <int d>
Eigen::Vector3d rotation_in_space(const rigid::Rotation<d>& rotation) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  vector.tail<rigid::rotations<d>>() = rotation;
  return vector;
}

/// In the shape's frame.
template <int d>
rigid::Shape<d> shape_of(const Shape& shape);
/// With the scene's mass or density and overrides; unit mass and inertia 1 for bodies that have neither.
/// `centre` is in the shape's frame.
template <int d>
rigid::MassProperties<d> mass_properties(const Body& body);

template <int d>
Eigen::Matrix<double, d, d> rotation(const Attitude& attitude);
/// Of a body whose attitude changes at such a rate, angle by angle [rad/s].
template <int d>
rigid::Rotation<d> angular_velocity(const Attitude& attitude, const Attitude& rate);

/// Shape frame to world.
template <int d>
rigid::Isometry<d> shape_pose(const Point& position, const Attitude& attitude);
template <int d>
rigid::Isometry<d> shape_pose(const Body& body) {
  return shape_pose<d>(body.position, body.attitude);
}

/// Boundary in the world frame, normals outward.
template <int d>
rigid::Surface<d> outline(const Region& region);
/// Fills `whole`, so that a union in space, which takes seconds, is computed once; leaves it null if there is no outline.
void unite_in_space(UnionRegion& region);
/// In the world frame at t = 0.
template <int d>
rigid::Surface<d> outline(const Body& body);
/// Smallest angle between the horizontal and a bottom with a keel or corner, beside its lowest point, at t = 0 [rad]; none of
/// round bottoms.
template <int d>
std::optional<double> deadrise(const Body& body);
/// Turned inside out: encloses what is outside it.
template <int d>
rigid::Surface<d> tank_outline(const Tank& tank);

template <int d>
using Extents = Eigen::AlignedBox<double, d>;
template <int d>
Extents<d> extents(const rigid::Surface<d>& surface);
template <int d>
Extents<d> extents(const Tank& tank) {
  return {vec<d>(tank.min), vec<d>(tank.max)};
}

// As messages write them: "(1, 2)", "[0, 1] x [0, 2]".
template <int d>
std::string text(const rigid::Vec<d>& x, int digits = 6);
template <int d>
std::string text(const Extents<d>& box);

}  // namespace splashdown::apps
