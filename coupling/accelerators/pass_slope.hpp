// Slope of a coupling pass x -> fluid -> loads -> bodies -> G(x) at t_n, found by probing both sides once.
//
//   G = (s~ + C B phi, Q phi),   phi = (A + K)^-1 (b - B^T s + Q^T L m),   x = (s, m)
//
//   dG/dx = [ -C G_K     C B (A + K)^-1 Q^T L ]      G_K = B (A + K)^-1 B^T
//           [ -Q Y_K     Q   (A + K)^-1 Q^T L ]      Y_K = (A + K)^-1 B^T
//
// G_K: added mass of all free bodies together. Without an interface Laplacian only the first entry is left. The fluid's
// part costs one right-hand side an entry of x on the factor that is there. C: the bodies' answer, whatever ties
// them. What the corrections of the pressure add to G is left out.
#pragma once

#include <Eigen/Core>

#include "fluid/fluid.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::coupling {

/// Between `begin` and `commit` of both sides. Entries as of Interface: twists of all bodies [m/s, rad/s], zero for
/// those that are not free, then impulses [Pa s].
template <int d>
Eigen::MatrixXd pass_slope(const fluid::Fluid<d>& fluid, const rigid::Bodies<d>& bodies);

extern template Eigen::MatrixXd pass_slope<2>(const fluid::Fluid<2>&, const rigid::Bodies<2>&);
extern template Eigen::MatrixXd pass_slope<3>(const fluid::Fluid<3>&, const rigid::Bodies<3>&);

}  // namespace splashdown::coupling
