// What fluid and bodies have to agree about, as one vector of velocities [m/s].
//
//   twists     (V, omega * radius of gyration) of each body
//   impulses   mean phi_I of each piece of a hull with an interface Laplacian, times sqrt(l_I |hull|) / (m + m_w):
//              the norm of these entries is |hull| rms(phi) / (m + m_w), the velocity that the impulse gives to
//              the body with the water of mass m_w that it has to move, here that of its own volume.
//              l_I: measure of the piece, |hull|: of all
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fluid/fluid.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::coupling {

template <int d>
struct Interface {
  std::vector<fluid::Twist<d>> twists;  ///< of each body
  std::vector<double> impulses;         ///< as Fluid::interface_impulse
};

template <int d>
class InterfaceSpace {
 public:
  InterfaceSpace(const rigid::Bodies<d>& bodies, std::span<const fluid::InterfacePiece> pieces, double fluid_density);
  Eigen::VectorXd vector(const Interface<d>& interface) const;
  Eigen::VectorXd velocities(const std::vector<fluid::Twist<d>>& twists) const;
  /// A slope between entries of Interface, as one between vectors.
  Eigen::MatrixXd slope(const Eigen::MatrixXd& of_interface) const;
  /// Adds a change; twists of bodies that are not free stay.
  void add(const Eigen::VectorXd& change, Interface<d>& interface) const;

 private:
  std::vector<bool> free_;
  Eigen::VectorXd weight_;  // of the twists, then of the impulses
};

extern template class InterfaceSpace<2>;
extern template class InterfaceSpace<3>;

}  // namespace splashdown::coupling
