// A number for each coordinate of a wall: its velocities, or impulses and forces conjugate to them.
//
//   rigid      d(d+1)/2: twist, or wrench, about the reference point of the wall
//   deforming  d a vertex of its surface: what lies between vertices moves with their linear interpolation, and an impulse
//              there is shared out by the same weights, so that velocity . impulse is work
//
// World frame.
#pragma once

#include <span>
#include <vector>

#include "core/types.hpp"

namespace splashdown {

/// A column a vertex of a surface.
template <int d>
using AtVertices = Eigen::Matrix<double, d, Eigen::Dynamic>;

/// Numbers of one wall. Only one of its two parts is used; without vertices, a deforming wall's are all zero.
template <int d>
struct WallVector {
  Twist<d> rigid = Twist<d>::Zero();  ///< (V, w) or (F, M); zero for walls that deform
  AtVertices<d> vertices = {};        ///< empty for rigid walls

  WallVector() = default;
  /// Of a rigid wall.
  template <class Derived>
  WallVector(const Eigen::MatrixBase<Derived>& of_rigid) : rigid(of_rigid) {}  // NOLINT: a twist is one
  /// Of a deforming wall.
  static WallVector at_vertices(AtVertices<d> values) {
    WallVector out;
    out.vertices = std::move(values);
    return out;
  }

  /// In place, coordinate by coordinate.
  WallVector& operator+=(const WallVector& other) {
    rigid += other.rigid;
    if (other.vertices.size() > 0) at(other) += other.vertices;
    return *this;
  }
  /// The same.
  WallVector& operator-=(const WallVector& other) {
    rigid -= other.rigid;
    if (other.vertices.size() > 0) at(other) -= other.vertices;
    return *this;
  }
  /// The same.
  WallVector& operator*=(double factor) {
    rigid *= factor;
    vertices *= factor;
    return *this;
  }
  /// The same.
  WallVector& operator/=(double divisor) {
    rigid /= divisor;
    vertices /= divisor;
    return *this;
  }
  /// With the other sign.
  WallVector operator-() const { return -1.0 * *this; }
  /// Zero in all coordinates.
  void setZero() { rigid.setZero(), vertices.setZero(); }
  /// Work, power: velocities by what is conjugate to them.
  double dot(const WallVector& other) const {
    double sum = rigid.dot(other.rigid);
    if (vertices.size() > 0 && other.vertices.size() > 0) sum += vertices.cwiseProduct(other.vertices).sum();
    return sum;
  }
  /// Of the whole wall: the largest speed of a vertex, or what bounds that of a rigid wall's twist.
  double norm() const { return vertices.size() > 0 ? vertices.colwise().norm().maxCoeff() : rigid.norm(); }
  /// Whether no coordinate is infinite or no number.
  bool allFinite() const { return rigid.allFinite() && vertices.allFinite(); }

  /// Coordinate by coordinate.
  friend WallVector operator+(WallVector a, const WallVector& b) { return a += b; }
  /// The same.
  friend WallVector operator-(WallVector a, const WallVector& b) { return a -= b; }
  /// The same.
  friend WallVector operator*(double factor, WallVector a) { return a *= factor; }
  /// The same.
  friend WallVector operator/(WallVector a, double divisor) { return a /= divisor; }
  /// The same numbers.
  friend bool operator==(const WallVector& a, const WallVector& b) {
    return a.rigid == b.rigid && a.vertices.cols() == b.vertices.cols() && a.vertices == b.vertices;
  }

 private:
  AtVertices<d>& at(const WallVector& other) {
    if (vertices.size() == 0) vertices.setZero(d, other.vertices.cols());
    return vertices;
  }
};

/// (V, w) of a rigid wall [m/s, rad/s], or the velocities of a surface's vertices [m/s].
template <int d>
using WallVelocity = WallVector<d>;
/// (F, M) or impulses on vertices [N s; 2D: N s/m].
template <int d>
using WallImpulse = WallVector<d>;

/// Where the coordinates of each wall stand among those of all walls, one below the other.
template <int d>
class WallLayout {
 public:
  /// `vertices`: of the surface of each wall that deforms; 0: the wall is rigid.
  explicit WallLayout(std::span<const Eigen::Index> vertices) {
    for (const Eigen::Index count : vertices) first_.push_back(first_.back() + (count > 0 ? d * count : freedoms<d>));
  }
  WallLayout() = default;
  /// Of so many rigid walls.
  static WallLayout rigid(std::size_t walls) { return WallLayout(std::vector<Eigen::Index>(walls, 0)); }
  std::size_t walls() const { return first_.size() - 1; }                                 ///< how many
  Eigen::Index first(std::size_t wall) const { return first_[wall]; }                     ///< coordinate of a wall
  Eigen::Index count(std::size_t wall) const { return first_[wall + 1] - first_[wall]; }  ///< of a wall's coordinates
  /// Whether a wall deforms: no surface has as few coordinates as a rigid body.
  bool deforms(std::size_t wall) const { return count(wall) != freedoms<d>; }
  Eigen::Index size() const { return first_.back(); }  ///< coordinates of all walls
  /// How many walls this many coordinates belong to; -1: they end within one.
  int walls_of(Eigen::Index coordinates) const {
    for (std::size_t w = 0; w < first_.size(); ++w)
      if (first_[w] == coordinates) return static_cast<int>(w);
    return -1;
  }
  /// Of a wall, out of numbers of all coordinates.
  template <class Numbers>
  WallVector<d> of_wall(std::size_t wall, const Numbers& all) const {
    if (!deforms(wall)) return WallVector<d>(Twist<d>(all.template segment<freedoms<d>>(first(wall))));
    const Eigen::VectorXd own = all.segment(first(wall), count(wall));
    return WallVector<d>::at_vertices(own.reshaped(d, count(wall) / d));
  }
  /// Numbers of a wall, one below the other.
  Eigen::VectorXd stacked(std::size_t wall, const WallVector<d>& own) const {
    if (!deforms(wall)) return own.rigid;
    return own.vertices.size() > 0 ? Eigen::VectorXd(own.vertices.reshaped()) : Eigen::VectorXd::Zero(count(wall));
  }
  /// Zero in all coordinates of a wall.
  WallVector<d> zero(std::size_t wall) const {
    return deforms(wall) ? WallVector<d>::at_vertices(AtVertices<d>::Zero(d, count(wall) / d)) : WallVector<d>();
  }
  /// One in a coordinate of a wall, zero in its others.
  WallVector<d> unit(std::size_t wall, Eigen::Index coordinate) const {
    WallVector<d> out = zero(wall);
    (deforms(wall) ? out.vertices(coordinate % d, coordinate / d) : out.rigid[coordinate]) = 1;
    return out;
  }
  /// Z^T I of impulses on all walls, Z: a row for each coordinate of all walls, a column a mode.
  Eigen::VectorXd on_modes(const Eigen::MatrixXd& modes, std::span<const WallVector<d>> impulses) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(modes.cols());
    if (modes.cols() == 0) return sum;
    for (std::size_t w = 0; w < impulses.size(); ++w) {
      const WallVector<d>& on = impulses[w];
      if (!deforms(w))
        sum += modes.middleRows(first(w), freedoms<d>).transpose() * on.rigid;
      else if (on.vertices.size() > 0)
        sum += modes.middleRows(first(w), count(w)).transpose() * on.vertices.reshaped();
    }
    return sum;
  }

 private:
  std::vector<Eigen::Index> first_ = {0};
};

}  // namespace splashdown
