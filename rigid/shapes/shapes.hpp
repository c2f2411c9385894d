// Outlines of planar bodies: closed polygons, counter-clockwise, with their exact mass properties.
//
// Every shape comes in a frame of its own (stated below), not about its centre of mass: `centred` moves
// it there. Curves become polygons with `segments` segments around, all vertices on the curve.
// Impossible values are std::invalid_argument; the text states rule and value.
#pragma once

#include <span>

#include "rigid/shapes/mass_properties.hpp"

namespace splashdown::rigid {

/// A closed surface [m] and the mass properties of the exact shape that it stands for.
template <int d>
struct Shape {
  Surface<d> surface;                 ///< in the shape's own frame
  MassProperties<d> at_unit_density;  ///< of the exact shape; centre in the shape's own frame
};

/// Of 360 degrees; the circle's polygon is 7.5e-5 of the radius inside the circle at most.
inline constexpr int default_segments = 256;

/// Straight from each point [m] to the next and back to the first, the body to the left. Nothing is asked of the points.
Surface<2> closed_polyline(std::span<const Vec<2>> points);

/// Enclosed by the points and the line from the last to the first, positive if they run counter-clockwise [m^2].
double signed_area(std::span<const Vec<2>> points);

/// At least three points [m], not repeated (the outline closes by itself), no edge touching another one.
/// Either sense of rotation. In the frame of the points.
Shape<2> polygon(std::span<const Vec<2>> points);

/// Keel at the origin, lowest; chines at (+-breadth/2, breadth/2 tan(deadrise)); vertical sides of height
/// `side` >= 0 above them [m]; flat top. Deadrise in radians, between 0 and pi/2.
Shape<2> wedge(double deadrise, double breadth, double side);

/// Centre at the origin, width along x [m]. A plate is a thin box.
Shape<2> box(double width, double height);

/// Centre at the origin, radius [m].
Shape<2> circle(double radius, int segments = default_segments);

/// Centre at the origin, semi-axis a along x, b along y; vertices at equal steps of the parameter.
Shape<2> ellipse(double a, double b, int segments = default_segments);

/// A rectangle of length `straight` and height 2 radius between two half discs: long axis along x, centre
/// at the origin. Even number of segments, counted around the two half discs.
Shape<2> capsule(double radius, double straight, int segments = default_segments);

/// x - centre for all vertices: the surface in the body frame, if `centre` is the centre of mass [m].
template <int d>
Surface<d> centred(Surface<d> surface, const Vec<d>& centre);

}  // namespace splashdown::rigid
