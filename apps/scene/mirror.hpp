// A scene's plane of symmetry, and what lies where in its mirror image.
#pragma once

#include <optional>

#include "apps/scene/geometry.hpp"
#include "core/mirror.hpp"

namespace splashdown::apps {

/// Lengths and directions that people write are equal within this share.
inline constexpr double written_digits = 1e-6;

/// The plane that ends what is simulated; nothing: all of the scene is.
std::optional<Mirror> mirror_of(const Scene& scene);

/// The same plane in the frame of a body's shape, which it does not move in: normal . x = offset. What is simulated lies where
/// normal . x >= offset.
template <int d>
struct ShapeMirror {
  rigid::Vec<d> normal = rigid::Vec<d>::Zero();  ///< unit
  double offset = 0;                             ///< [m]

  double distance(const rigid::Vec<d>& x) const { return normal.dot(x) - offset; }
  rigid::Vec<d> image(const rigid::Vec<d>& x) const { return x - 2 * distance(x) * normal; }
  /// The point or its image, whichever is simulated.
  rigid::Vec<d> kept(const rigid::Vec<d>& x) const { return distance(x) < 0 ? image(x) : x; }
};
/// At t = 0, `pose` from the shape's frame to the world.
template <int d>
ShapeMirror<d> in_frame(const Mirror& mirror, const rigid::Isometry<d>& pose);

/// How far a point of a body, at t = 0 and in the frame of its shape, is off the plane, if by more than written digits of its size [m].
template <int d>
std::optional<double> off_plane(const Mirror& mirror, const Body& body, const rigid::Vec<d>& point);

/// How far the mirror image of a surface is off the surface.
template <int d>
struct Asymmetry {
  double distance = 0;                       ///< the largest of any vertex [m]
  rigid::Vec<d> at = rigid::Vec<d>::Zero();  ///< that vertex
};
/// Surface and plane in the world.
template <int d>
Asymmetry<d> asymmetry_of(const Mirror& mirror, const rigid::Surface<d>& surface);

/// The part of a surface on the simulated side, its facets cut at the plane: open there. Vertices within roundoff of the plane lie
/// in it.
template <int d>
rigid::Surface<d> kept_part(const ShapeMirror<d>& mirror, const rigid::Surface<d>& surface);
/// `kept_part` and its image, joined: closed, and symmetric to the last vertex.
template <int d>
rigid::Surface<d> symmetrised(const ShapeMirror<d>& mirror, const rigid::Surface<d>& surface);

}  // namespace splashdown::apps
