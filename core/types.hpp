// Types that all rooms share. World frame, SI units; two-dimensional quantities are per metre of depth.
//
// A twist stacks the linear velocity V [m/s] of a reference point and the angular velocity w [rad/s], a wrench the force F [N]
// and the moment M [N m] about that point. In two dimensions w and M have one entry (counter-clockwise positive).
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

/// Light bodies that land on water. SI units; two-dimensional quantities are per metre of depth.
namespace splashdown {

/// A point, a velocity, a force: d components, world frame unless something else is said.
template <int d>
using Vec = Eigen::Matrix<double, d, 1>;
/// d x d: a rotation, a gradient, a projector.
template <int d>
using Mat = Eigen::Matrix<double, d, d>;
/// A pose: rotation and translation, from a body or wall frame to the world unless something else is said.
template <int d>
using Isometry = Eigen::Transform<double, d, Eigen::Isometry>;

/// Rotational degrees of freedom: 1 in two dimensions, 3 in three.
template <int d>
inline constexpr int rotations = d*(d - 1) / 2;
/// All degrees of freedom of a rigid body: 3 in two dimensions, 6 in three.
template <int d>
inline constexpr int freedoms = d + rotations<d>;

/// (V, w): velocity of a reference point [m/s] and angular velocity [rad/s], world frame.
template <int d>
using Twist = Eigen::Matrix<double, freedoms<d>, 1>;
/// (F, M): force [N; 2D: N/m] and moment about a reference point [N m; 2D: N], world frame. Twist . wrench is power.
template <int d>
using Wrench = Eigen::Matrix<double, freedoms<d>, 1>;

/// Moments of inertia, one in 2D.
template <int d>
using Inertia = Eigen::Matrix<double, rotations<d>, rotations<d>>;

/// Closed, oriented simplicial surface: polyline (d = 2) or triangle mesh (d = 3). Normals point out of what the surface
/// encloses: a 2D outline runs counter-clockwise, in 3D the right-hand rule gives the normal.
template <int d>
struct Surface {
  Eigen::Matrix<double, d, Eigen::Dynamic> vertices;  ///< [m], d x n
  Eigen::Matrix<int, d, Eigen::Dynamic> facets;       ///< vertex indices, d x m
};

}  // namespace splashdown
