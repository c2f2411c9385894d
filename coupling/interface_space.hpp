// What fluid and structure have to agree about, as one vector of velocities [m/s].
//
//   motion     each coordinate times its scale (of a rigid wall V, omega * radius of gyration)
//   lagged     mean phi_I of each piece of a hull with an interface Laplacian, times sqrt(l_I |hull|) / (m + m_w):
//              the norm of these entries is |hull| rms(phi) / (m + m_w), the velocity that the impulse gives to
//              the body with the water of mass m_w that it has to move, here that of its own volume.
//              l_I: measure of the piece, |hull|: of all
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "coupling/participant.hpp"

namespace splashdown::coupling {

struct Interface {
  Motion motion;           ///< of all walls of the structure
  Eigen::VectorXd lagged;  ///< as Solution::lagged [Pa s]
};

class InterfaceSpace {
 public:
  InterfaceSpace(const StructurePart& structure, std::span<const InterfacePiece> pieces, double fluid_density);
  Eigen::VectorXd vector(const Interface& interface) const;
  Eigen::VectorXd velocities(const Motion& motion) const;
  /// A slope between entries of Interface, as one between vectors.
  Eigen::MatrixXd slope(const Eigen::MatrixXd& of_interface) const;
  /// Adds a change; motions of walls that do not answer stay.
  void add(const Eigen::VectorXd& change, Interface& interface) const;

 private:
  const std::vector<WallCoordinates>& walls_;
  Eigen::VectorXd weight_;  // of the motion, then of the lagged impulses
};

}  // namespace splashdown::coupling
