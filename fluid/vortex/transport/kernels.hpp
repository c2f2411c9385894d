// Kernels that give particles back to a grid. The sums of their values over integers is one for any shift, so that
// circulation is kept to roundoff, and so are moments below the order.
#pragma once

#include <cmath>

namespace splashdown::vortex {

/// M'4 of Monaghan (J. Comput. Phys. 60, 1985): keeps moments 0, 1, 2; reaches two nodes to either side.
inline double m4(double x) {
  const double a = std::abs(x);
  if (a < 1) return 1 + a * a * (1.5 * a - 2.5);
  return a < 2 ? 0.5 * (2 - a) * (2 - a) * (1 - a) : 0.0;
}

/// M'6 of Bergdorf & Koumoutsakos (Multiscale Model. Simul. 5, 2006): keeps moments 0 to 3; reaches three nodes.
inline double m6(double x) {
  const double a = std::abs(x);
  if (a < 1) return -(a - 1) * ((((25 * a - 38) * a - 3) * a + 12) * a + 12) / 12;
  if (a < 2) return (a - 1) * (a - 2) * (((25 * a - 114) * a + 153) * a - 48) / 24;
  return a < 3 ? -(a - 2) * (a - 3) * (a - 3) * (a - 3) * (5 * a - 8) / 24 : 0.0;
}

}  // namespace splashdown::vortex
