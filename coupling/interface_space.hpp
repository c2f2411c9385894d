// What fluid and structure have to agree about, as one vector of velocities [m/s].
//
//   velocities each coordinate times its scale (of a rigid wall V, omega * radius of gyration)
//   lagged     mean phi_I of each piece of a hull with an interface Laplacian, times
//              sqrt(l_I |hull|) / sqrt(m (m + m_w)), l_I: measure of the piece, |hull|: of all,
//              m_w: mass of the water in the body's place
//
// A pass multiplies an error of phi by |hull| / m on its way to the body, which answers alone, and an error of the
// body's velocity by about m_w / |hull| on its way to phi. The weight makes the two slopes equal, sqrt(m_w / m): a
// balanced matrix (Osborne 1960; Parlett, Reinsch 1969), whose residuals mean the same in both parts. With m + m_w
// for m_w heavy bodies weigh phi by the velocity that it gives them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "coupling/participant.hpp"

namespace splashdown::coupling {

/// What the two sides have to agree about.
struct Interface {
  Velocities velocities;   ///< of all walls of the structure
  Eigen::VectorXd lagged;  ///< as Solution::lagged [Pa s]
};

/// Maps between Interface and the vector that accelerators see.
class InterfaceSpace {
 public:
  /// `fluid_density` [kg/m^3], for the water's mass in a body's place. Refers to the structure's walls.
  InterfaceSpace(const StructurePart& structure, std::span<const InterfacePiece> pieces, double fluid_density);
  /// (scales * velocities, weights * lagged), as above [m/s].
  Eigen::VectorXd vector(const Interface& interface) const;
  /// scales * velocities [m/s]: the part of the walls.
  Eigen::VectorXd scaled(const Velocities& velocities) const;
  /// A slope between entries of Interface, as one between vectors.
  Eigen::MatrixXd slope(const Eigen::MatrixXd& of_interface) const;
  /// Adds a change [m/s]; velocities of walls that do not answer stay.
  void add(const Eigen::VectorXd& change, Interface& interface) const;

 private:
  const std::vector<WallCoordinates>& walls_;
  Eigen::VectorXd weight_;  // of the velocities, then of the lagged impulses
};

}  // namespace splashdown::coupling
