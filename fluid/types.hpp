// Types shared by the fluid room. World frame, SI units; two-dimensional quantities are per metre depth.
//
// A twist stacks the linear velocity V [m/s] of a wall's reference point and its angular velocity w [rad/s];
// a wrench stacks force and moment about that point.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

namespace splashdown::fluid {

template <int d>
using Vec = Eigen::Matrix<double, d, 1>;
template <int d>
using Mat = Eigen::Matrix<double, d, d>;
template <int d>
using Isometry = Eigen::Transform<double, d, Eigen::Isometry>;

template <int d>
inline constexpr int rotations = d*(d - 1) / 2;
template <int d>
inline constexpr int freedoms = d + rotations<d>;

template <int d>
using Twist = Eigen::Matrix<double, freedoms<d>, 1>;
template <int d>
using Wrench = Eigen::Matrix<double, freedoms<d>, 1>;

/// Closed, oriented simplicial surface: polyline (d = 2) or triangle mesh (d = 3). Normals point out of
/// what the surface encloses: a 2D outline runs counter-clockwise.
template <int d>
struct Surface {
  Eigen::Matrix<double, d, Eigen::Dynamic> vertices;  ///< [m], d x n
  Eigen::Matrix<int, d, Eigen::Dynamic> facets;       ///< vertex indices, d x m
};

}  // namespace splashdown::fluid
