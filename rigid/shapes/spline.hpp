// Outlines and profiles that are B-splines, as polygons near enough to them.
#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "rigid/shapes/shapes.hpp"

namespace splashdown::rigid {

/// C(u) = sum_i N_i,p(u) P_i with uniform knots, N_i,p the basis of degree p, P_i the control points [m] (de Boor 1972). The
/// curve stays in the convex hull of each p + 1 neighbours; p equal points after each other are a corner, p + 1 on a line a
/// straight piece.
struct Spline {
  std::vector<Vec<2>> points;  ///< at least degree + 1; of a closed one at least 3
  int degree = 3;              ///< 1 (straight between the points) to 5
  /// A closed curve is periodic: smooth everywhere. An open one begins in the first point and ends in the last, tangential to the
  /// first and last pieces of its control polygon.
  bool closed = false;
  double tolerance = 0;  ///< how far a chord may be off the curve [m]; 0: 5e-5 of the largest extent, as of a circle
};

inline constexpr double largest_turn = 3 * std::numbers::pi / 180;  ///< from chord to chord, but at corners [rad]

/// Points on the curve from one end to the other, each once; of a closed one without the last, which is the first. Chords miss it
/// by the tolerance at most and turn by `largest_turn` at most, but at corners. Throws std::invalid_argument for too few points,
/// points that are not finite, and tolerances that need more than 1e5 chords.
std::vector<Vec<2>> sampled(const Spline& spline);

/// The outline: an open curve is closed by a straight line. In the frame of its points; mass properties of the curve itself,
/// within 1e-4 of what the polygon's are off. Throws std::invalid_argument if it meets itself, too.
Shape<2> outline_of(const Spline& spline);

/// The open curve as a profile (r, z), turned about the z axis; r >= 0. An end that is not on the axis is closed by a flat disc.
Shape<3> solid_of(const Spline& spline);

}  // namespace splashdown::rigid
