// The fundamental solution of the five-point Laplacian on the infinite lattice of unit squares: -Laplace_5 G = delta,
//
//   G(m, n) = -1/(2 pi) int_0^pi (1 - e^{-|m| s} cos(n b)) / sinh s  db,   cosh s = 2 - cos b,   G(0, 0) = 0
//
// by Gauss's rule near the origin, beyond by the series of Martinsson & Rodin (Proc. R. Soc. A 458, 2002, eq. 2.6).
// Accuracy 1e-10.
#pragma once

namespace splashdown::vortex {

/// G(m, n); symmetric in the signs and in the order of m and n.
double lattice_green(int m, int n);

/// G(0, 0) - G far away is (log r + this)/(2 pi): Euler's constant and log(8)/2.
inline constexpr double lattice_offset = 0.57721566490153286 + 1.03972077083991797;

}  // namespace splashdown::vortex
