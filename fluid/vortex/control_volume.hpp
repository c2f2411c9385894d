// What bodies in a rectangle do to the fluid in it, by what happens on its sides and to the vorticity inside: no pressure,
// no penalty (Noca, Shiels & Jeon, J. Fluids Struct. 13, 1999). With r from a point and n out of the rectangle,
//
//   int f     = d/dt int (y, -x) omega + oint (y, -x) omega u.n - oint (u^2 n/2 - u u.n)
//               - nu oint ((y, -x) d_n omega - omega (n_y, -n_x))
//   int r x f = -d/dt int r^2 omega/2 - oint r^2 omega u.n/2 - oint r x (u^2 n/2 - u u.n)
//               + nu oint (r^2 d_n omega/2 - omega r.n) + 2 nu int omega
//
// Exact for all f inside. Trapezoidal rule along nodes: second order.
#pragma once

#include "core/types.hpp"
#include "fluid/vortex/grid.hpp"

namespace splashdown::vortex {

/// Nodes first <= (i, j) <= last, at least two inside the grid's sides.
struct NodeBox {
  int first_i, first_j, last_i, last_j;
};

/// Fields at the beginning and the end of a time.
struct Change {
  const NodeField &omega, &omega_after;        ///< [1/s]
  const FaceField &velocity, &velocity_after;  ///< [m/s]
  double time;                                 ///< between them [s]
};

/// int f and int r x f about a point [m^3/s^2, m^4/s^2].
Wrench<2> force_in(const Grid& grid, const NodeBox& box, const Change& change, double viscosity, const Vec<2>& about);

}  // namespace splashdown::vortex
