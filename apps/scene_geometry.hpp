// Outlines and mass properties of what a scene describes, in two dimensions.
//
// Shape frame: as drawn, origin at the shape's reference point. Body frame: origin at the centre of mass.
// World frame of a shape at t = 0: position + R(pitch) x. Impossible shapes throw std::invalid_argument.
#pragma once

#include <Eigen/Geometry>

#include "apps/scene.hpp"
#include "rigid/shapes.hpp"

namespace splashdown::apps {

inline rigid::Vec<2> planar(const Point& point) { return point.head<2>(); }

/// In the shape's frame.
rigid::Shape<2> shape_of(const Shape& shape);
/// With the scene's mass or density and overrides; unit mass and inertia 1 for bodies that have neither.
/// `centre` is in the shape's frame.
rigid::MassProperties<2> mass_properties(const Body& body);

/// Shape frame to world.
rigid::Isometry<2> shape_pose(const Point& position, double pitch_deg);
inline rigid::Isometry<2> shape_pose(const Body& body) { return shape_pose(body.position, body.pitch_deg); }

/// Counter-clockwise boundary in the world frame.
rigid::Surface<2> outline(const Region& region);
/// In the world frame at t = 0.
rigid::Surface<2> outline(const Body& body);
/// Clockwise: encloses what is outside it.
rigid::Surface<2> tank_outline(const Tank& tank);

using Extents = Eigen::AlignedBox<double, 2>;
Extents extents(const rigid::Surface<2>& surface);

/// Distance from a point to an outline, negative inside what it encloses.
double signed_distance(const rigid::Surface<2>& surface, const rigid::Vec<2>& point);
/// The interiors of two outlines share more than their edges.
bool overlap(const rigid::Surface<2>& a, const rigid::Surface<2>& b);

}  // namespace splashdown::apps
