// Natural modes of the solid at rest, K(0) x = w^2 M x in the free unknowns: the lowest ones by Lanczos with a shift below zero
// (Spectra; Ericsson, Ruhe 1980), so that free bodies, whose K is singular, need nothing special: they have 3 modes of
// frequency zero in the plane and 6 in space.
#pragma once

#include "core/status.hpp"
#include "elastic/assembly/system.hpp"

namespace splashdown::elastic {

/// From the lowest up.
struct Modes {
  Status status;                        ///< whether all that were asked for are here
  Eigen::VectorXd angular_frequencies;  ///< w [rad/s]
  Eigen::MatrixXd shapes;               ///< x, a column each, x^T M x = 1 [1/sqrt(kg)]; zero where unknowns are held
};

/// The lowest `count` modes about the displacements u. Throws std::invalid_argument unless 0 < count < number of free unknowns.
Modes lowest_modes(const System& system, int count, const Field& u);

}  // namespace splashdown::elastic
