// Types shared by the rigid-body room.
//
// A twist stacks the linear velocity V [m/s] of the centre of mass and the angular velocity w [rad/s],
// a wrench the force F [N] and the moment M [N m] about the centre of mass; both in the world frame.
// In two dimensions w and M have one entry (counter-clockwise positive) and loads are per metre depth.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace splashdown::rigid {

template <int d>
using Vec = Eigen::Matrix<double, d, 1>;

template <int d>
using Isometry = Eigen::Transform<double, d, Eigen::Isometry>;

/// Rotational and total degrees of freedom: 1 and 3 in two dimensions, 3 and 6 in three.
template <int d>
inline constexpr int rotations = d*(d - 1) / 2;
template <int d>
inline constexpr int freedoms = d + rotations<d>;

template <int d>
using Rotation = Eigen::Matrix<double, rotations<d>, 1>;
template <int d>
using Inertia = Eigen::Matrix<double, rotations<d>, rotations<d>>;
template <int d>
using Twist = Eigen::Matrix<double, freedoms<d>, 1>;
template <int d>
using Wrench = Eigen::Matrix<double, freedoms<d>, 1>;

/// Closed, oriented simplicial surface: polyline (d = 2) or triangle mesh (d = 3).
/// Facets are oriented so that the normal points out of the solid: in 2D the solid lies to the left of
/// a facet (counter-clockwise outline), in 3D the right-hand rule gives the outward normal.
template <int d>
struct Surface {
  Eigen::Matrix<double, d, Eigen::Dynamic> vertices;  ///< [m], d x n
  Eigen::Matrix<int, d, Eigen::Dynamic> facets;       ///< vertex indices, d x m
};

}  // namespace splashdown::rigid
