// Slope of a coupling pass x -> fluid -> impulses -> structure -> G(x) at t_n, found by probing both sides once.
//
//   G = (s~ + C B phi, Q phi),   phi = (A + K)^-1 (b - B^T s + Q^T L m),   x = (s, m)
//
//   dG/dx = [ -C G_K     C B (A + K)^-1 Q^T L ]      G_K = B (A + K)^-1 B^T
//           [ -Q Y_K     Q   (A + K)^-1 Q^T L ]      Y_K = (A + K)^-1 B^T
//
// G_K: added mass of all walls that answer together. Without a stand-in only the first entry is left. The fluid's
// part costs one right-hand side an entry of x on the factor that is there. C = Z W (W^T M W)^-1 W^T Z^T: the
// structure's answer, whatever ties it. What the corrections of the pressure add to G is left out.
#pragma once

#include <Eigen/Core>

#include "coupling/participant.hpp"

namespace splashdown::coupling {

/// Between `begin` and `commit` of both sides. Entries as of Interface: motions of all walls [m/s, rad/s, ...], zero for
/// those that do not answer, then lagged impulses [Pa s]. Throws std::invalid_argument for a fluid that knows no slope.
Eigen::MatrixXd pass_slope(const FluidPart& fluid, const StructurePart& structure);

}  // namespace splashdown::coupling
