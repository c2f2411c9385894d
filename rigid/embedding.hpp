// Planar bodies as three-dimensional ones. Internal to the rigid-body room.
//
// A body in d dimensions is a body in 3D whose other freedoms are held: in two dimensions z, w_x and
// w_y. Everything that moves bodies is therefore written once, in 3D.
#pragma once

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// E with (V, w)_space = E (V, w)_d and, because the columns are unit vectors, (V, w)_d = E^T (V, w)_space.
template <int d>
Eigen::Matrix<double, freedoms<3>, freedoms<d>> embedding() {
  Eigen::Matrix<double, freedoms<3>, freedoms<d>> e;
  e.setZero();
  e.template topLeftCorner<d, d>().setIdentity();
  e.template bottomRightCorner<rotations<d>, rotations<d>>().setIdentity();
  return e;
}

/// A pose in 2D as one in 3D, about z; itself in 3D.
template <int d>
Isometry<3> embedded(const Isometry<d>& pose) {
  Isometry<3> space = Isometry<3>::Identity();
  space.linear().template topLeftCorner<d, d>() = pose.linear();
  space.translation().template head<d>() = pose.translation();
  return space;
}

/// Back again: what of a pose in 3D lies in the plane.
template <int d>
Isometry<d> projected(const Isometry<3>& space) {
  Isometry<d> pose = Isometry<d>::Identity();
  pose.linear() = space.linear().topLeftCorner<d, d>();
  pose.translation() = space.translation().head<d>();
  return pose;
}

/// The moments of inertia about held axes do not matter; one keeps the tensor invertible.
template <int d>
Inertia<3> lifted_inertia(const Inertia<d>& inertia) {
  Inertia<3> space = Inertia<3>::Identity();
  space.template bottomRightCorner<rotations<d>, rotations<d>>() = inertia;
  return space;
}

}  // namespace splashdown::rigid
