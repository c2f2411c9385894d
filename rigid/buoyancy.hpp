// Potential energy of bodies in still water, and how it changes as they move. Internal to the rigid-body room.
//
//   dE = -F . dx,   d^2 E = rho g int_(water plane) (dz)^2 dA + rho g V z_B |tilt|^2,   dz = dz_0 + tilt . p
//
// about the centre of mass, p the horizontal distance from it, z_B the height of the centre of buoyancy over it.
#pragma once

#include <vector>

#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::rigid {

/// Energy at a place, with minus its gradient and its curvature in displacements and turns of all bodies, one below the other.
template <int d>
struct Potential {
  double energy = 0;
  Eigen::VectorXd force;
  Eigen::MatrixXd stiffness;
  std::vector<Submerged<d>> submerged;
};

/// How a small motion of a body lifts the hull at the horizontal distance p from its centre of mass: first row, + p . the others.
template <int d>
Eigen::Matrix<double, d, freedoms<d>> lift_of_motion() {
  Eigen::Matrix<double, d, freedoms<d>> lift = Eigen::Matrix<double, d, freedoms<d>>::Zero();
  lift(0, d - 1) = 1;
  if constexpr (d == 2) {
    lift(1, 2) = 1;
  } else {
    lift(1, 4) = -1;
    lift(2, 3) = 1;
  }
  return lift;
}

/// Of the buoyancy of what is submerged, over rho g.
template <int d>
Eigen::Matrix<double, freedoms<d>, freedoms<d>> buoyant_stiffness(const Submerged<d>& s) {
  using Block = Eigen::Matrix<double, d, d>;
  Block plane = Block::Zero();
  plane(0, 0) = s.waterline;
  plane.template block<d - 1, 1>(1, 0) = s.waterline * s.waterline_centre;
  plane.template block<1, d - 1>(0, 1) = plane.template block<d - 1, 1>(1, 0).transpose();
  plane.template block<d - 1, d - 1>(1, 1) =
      s.waterline_moment + s.waterline * s.waterline_centre * s.waterline_centre.transpose() +
      s.volume * s.centre(d - 1) * Eigen::Matrix<double, d - 1, d - 1>::Identity();
  const auto lift = lift_of_motion<d>();
  Eigen::Matrix<double, freedoms<d>, freedoms<d>> stiffness = lift.transpose() * plane * lift;
  if constexpr (d == 3) {  // a turn about the vertical turns the horizontal axes of the others
    stiffness.template block<2, 1>(3, 5) -= 0.5 * s.volume * s.centre.template head<2>();
    stiffness.template block<1, 2>(5, 3) -= 0.5 * s.volume * s.centre.template head<2>().transpose();
  }
  return stiffness;
}

}  // namespace splashdown::rigid
