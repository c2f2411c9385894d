// How errors of goals fall with the elements, and what of them a mesh shows of which each cell is divided. Quadratic elements
// have an order of 4 where fields are smooth, and of 2 lambda at corners, where displacements or slow flow go like r^lambda. With
// kappa = 3 - 4 nu in plane strain and w the angle of the material (Williams 1952; Moffatt 1964 for slow flow, kappa = 1):
//
//   both sides free     sin(lambda w) = +- lambda sin(w)
//   both sides held     kappa sin(lambda w) = +- lambda sin(w)
//   one of each         sin^2(lambda w) = (kappa + 1)^2/(4 kappa) - lambda^2 sin^2(w)/kappa
#pragma once

namespace splashdown {

/// What holds a side of a corner.
enum class CornerSide { free, held };

/// Of errors of goals where fields are smooth.
inline constexpr double smooth_order = 4;
/// Sides that turn by less are curved, or as good as straight [rad].
inline constexpr double least_corner_turn = 0.17453292519943295;

/// The least real part of lambda, 1 where nothing is singular. `angle`: of the material, up to 2 pi.
double corner_exponent(double angle, CornerSide one, CornerSide other, double kappa);

/// An error over its part that a divided mesh shows: 1/(1 - 2^-order).
double over_shown(double order);

}  // namespace splashdown
