// Dimension-generic geometry of simplices and rigid motions.
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "core/types.hpp"

namespace splashdown {

/// Matrix of cofactors, det(J) J^-T without the division: flat cells are harmless.
inline Mat<2> cofactor(const Mat<2>& J) {
  Mat<2> c;
  c << J(1, 1), -J(1, 0), -J(0, 1), J(0, 0);
  return c;
}
/// The same in 3D.
inline Mat<3> cofactor(const Mat<3>& J) {
  Mat<3> c;
  c.col(0) = J.col(1).cross(J.col(2));
  c.col(1) = J.col(2).cross(J.col(0));
  c.col(2) = J.col(0).cross(J.col(1));
  return c;
}

/// d!, the inverse volume of the unit simplex.
template <int d>
inline constexpr double factorial = d == 0 ? 1.0 : d* factorial<(d > 0 ? d - 1 : 0)>;
/// Ends the recursion: 0! = 1.
template <>
inline constexpr double factorial<0> = 1.0;

/// Columns |e| grad N_j of a simplex with corners x_j; equally the gradients of its volume.
template <int d>
using VolumeGradients = Eigen::Matrix<double, d, d + 1>;

/// Columns x_j - x_0, j = 1..d, of a simplex; `corner(j)` gives x_j [m].
template <int d, class Corner>
Mat<d> edge_matrix(const Corner& corner) {
  const Vec<d> x0 = corner(0);
  Mat<d> J;
  for (int j = 0; j < d; ++j) J.col(j) = corner(j + 1) - x0;
  return J;
}

/// Signed volume det(x_j - x_0) / d! of a simplex [m^d]; `corner(j)` gives x_j. Positive where the corners are ordered by the
/// right hand (counter-clockwise in 2D).
template <int d, class Corner>
double volume(const Corner& corner) {
  return edge_matrix<d>(corner).determinant() / factorial<d>;
}

/// dV/dx_j = V grad N_j, a column each [m^(d-1)]; they sum to zero. Exact for flat and inverted simplices, too.
template <int d, class Corner>
VolumeGradients<d> volume_gradients(const Corner& corner) {
  VolumeGradients<d> g;
  g.template rightCols<d>() = cofactor(edge_matrix<d>(corner)) / factorial<d>;
  g.col(0) = -g.template rightCols<d>().rowwise().sum();
  return g;
}

/// Area vector of an oriented facet: unit normal times length [m] or area [m^2].
inline Vec<2> area_vector(const std::array<Vec<2>, 2>& f) { return {f[1].y() - f[0].y(), f[0].x() - f[1].x()}; }
/// The same in 3D: of a triangle, by the right hand.
inline Vec<3> area_vector(const std::array<Vec<3>, 3>& f) { return 0.5 * (f[1] - f[0]).cross(f[2] - f[0]); }
/// Length of an outline (2D) or area of a surface (3D) [m, m^2].
template <int d>
double measure(const Surface<d>& surface) {
  double sum = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    std::array<Vec<d>, d> corners;
    for (int k = 0; k < d; ++k) corners[k] = surface.vertices.col(surface.facets(k, f));
    sum += area_vector(corners).norm();
  }
  return sum;
}

/// w x r: velocity at r [m] from the centre of a rotation w [rad/s], which has one entry in 2D.
inline Vec<2> cross(const Eigen::Matrix<double, 1, 1>& w, const Vec<2>& r) { return {-w[0] * r.y(), w[0] * r.x()}; }
/// The same in 3D.
inline Vec<3> cross(const Vec<3>& w, const Vec<3>& r) { return w.cross(r); }
/// r x f: moment [N m; 2D: N] of a force f [N] that acts at r [m]; one entry in 2D.
inline Eigen::Matrix<double, 1, 1> moment(const Vec<2>& r, const Vec<2>& f) {
  return Eigen::Matrix<double, 1, 1>(r.x() * f.y() - r.y() * f.x());
}
/// The same in 3D.
inline Vec<3> moment(const Vec<3>& r, const Vec<3>& f) { return r.cross(f); }

/// V + w x r: velocity of a rigid body's point at r from its reference point [m/s]; one frame for all.
template <int d>
Vec<d> rigid_velocity(const Twist<d>& s, const Vec<d>& r) {
  return s.template head<d>() + cross(Eigen::Matrix<double, rotations<d>, 1>(s.template tail<rotations<d>>()), r);
}

/// Acceleration of a rigid body's point at r from its reference point: a + alpha x r + w x (w x r) [m/s^2]. `acceleration`:
/// of the reference point, and angular.
template <int d>
Vec<d> rigid_acceleration(const Vec<d>& r, const Twist<d>& velocity, const Twist<d>& acceleration) {
  if constexpr (d == 2) {
    const double alpha = acceleration(2), w = velocity(2);
    return Vec<2>(acceleration(0) - alpha * r.y() - w * w * r.x(), acceleration(1) + alpha * r.x() - w * w * r.y());
  } else {
    const Vec<3> alpha = acceleration.template tail<3>(), w = velocity.template tail<3>();
    return acceleration.template head<3>() + alpha.cross(r) + w.cross(w.cross(r));
  }
}

/// (f, r x f): wrench about the reference point of a force f [N] that acts at r [m] from it.
template <int d>
Wrench<d> wrench_of(const Vec<d>& r, const Vec<d>& f) {
  Wrench<d> w;
  w << f, moment(r, f);
  return w;
}

/// exp(w): rotation matrix of a rotation vector w [rad] (Rodrigues).
inline Mat<2> rotation(const Eigen::Matrix<double, 1, 1>& w) { return Eigen::Rotation2Dd(w[0]).toRotationMatrix(); }
/// The same in 3D. By way of the quaternion: a turn about a coordinate axis leaves that axis exactly where it is.
inline Mat<3> rotation(const Vec<3>& w) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(w.norm(), w.normalized())).toRotationMatrix();
}

/// Pose after dt [s] at constant twist in the world frame: x + dt V, exp(dt w) R.
template <int d>
Isometry<d> moved(const Isometry<d>& pose, const Twist<d>& s, double dt) {
  Isometry<d> out = pose;
  out.translation() += dt * s.template head<d>();
  out.linear() = rotation(Eigen::Matrix<double, rotations<d>, 1>(dt * s.template tail<rotations<d>>())) * pose.linear();
  return out;
}

}  // namespace splashdown
