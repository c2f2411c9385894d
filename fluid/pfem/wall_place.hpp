// Where a wall is: the pose of a rigid one, or the surface of one that deforms, with what searches it.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/anchor.hpp"
#include "core/facet_tree.hpp"
#include "core/wall_vector.hpp"
#include "fluid/pfem/geometry.hpp"
#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

using splashdown::Anchor;
using splashdown::AtVertices;
using splashdown::WallImpulse;
using splashdown::WallLayout;
using splashdown::WallVelocity;

/// The surface of a wall at one instant: of one that deforms in the world's frame, as it was made in the wall's. Its Wall makes
/// it.
template <int d>
struct WallShape {
  AtVertices<d> vertices;                                               ///< [m]
  std::shared_ptr<const Eigen::Matrix<int, d, Eigen::Dynamic>> facets;  ///< the same always
  AtVertices<d> normal;                                                 ///< of facets, unit, out of the solid
  AtVertices<d> vertex_normal;         ///< mean over the facets around a vertex, by their angles
  FacetTree<d> tree;                   ///< of all facets
  std::vector<FacetTree<d>> of_patch;  ///< of the facets of each smooth patch
  Eigen::AlignedBox<double, d> box;    ///< around it
  double spacing = 0;                  ///< of its vertices: mean size of facets [m]
};

/// Where a wall is, wall frame to world. A wall that deforms has its vertices in the world: its frame is that.
template <int d>
class WallPlace {
 public:
  WallPlace() : pose_(Isometry<d>::Identity()) {}
  /// Of a rigid wall.
  WallPlace(const Isometry<d>& pose) : pose_(pose) {}  // NOLINT: a pose is one
  /// Of one that deforms.
  explicit WallPlace(std::shared_ptr<const WallShape<d>> shape)
      : pose_(Isometry<d>::Identity()), shape_(std::move(shape)) {}

  const Isometry<d>& pose() const { return pose_; }                      ///< identity for walls that deform
  const WallShape<d>* shape() const { return shape_.get(); }             ///< nullptr: the wall is rigid
  const Vec<d> translation() const { return pose_.translation(); }       ///< reference point of a rigid wall [m]
  Mat<d> linear() const { return pose_.linear(); }                       ///< its rotation
  Isometry<d> inverse() const { return pose_.inverse(); }                ///< world to wall frame
  Vec<d> operator*(const Vec<d>& local) const { return pose_ * local; }  ///< wall frame to world

 private:
  Isometry<d> pose_;
  std::shared_ptr<const WallShape<d>> shape_;
};

/// What carries the point of a deforming wall that is nearest to x.
template <int d>
Anchor<d> anchor_of(const WallShape<d>& shape, const Vec<d>& x) {
  return anchor_on<d>(shape.vertices, *shape.facets, shape.tree, x);
}

/// A point of a facet of the fluid: shares of its nodes, and what of its area the point stands for.
template <int d>
struct FacetPoint {
  std::array<double, d> share;  ///< of the facet's nodes
  double weight;                ///< of its area; those of all points sum to 1
};
/// Points that integrate over a facet of this size [m] what a deforming wall does there: exact for products of linear
/// functions on each of some parts of it, which are no larger than the wall's facets, but for their number.
template <int d>
std::span<const FacetPoint<d>> points_of_facet(const WallShape<d>& shape, double size);

/// Velocity of the wall at a point x of it: V + w x r, or that of its vertices, interpolated [m/s].
template <int d>
Vec<d> velocity_at(const WallPlace<d>& place, const WallVelocity<d>& s, const Vec<d>& x) {
  if (!place.shape()) return rigid_velocity<d>(s.rigid, x - place.translation());
  return s.vertices.size() > 0 ? anchor_of<d>(*place.shape(), x).interpolate(s.vertices) : Vec<d>(Vec<d>::Zero());
}

/// Adds `times` an impulse that acts on the wall at a point x of it: as a wrench, or shared out among vertices.
template <int d>
void add_impulse(const WallPlace<d>& place, const Vec<d>& x, const Vec<d>& impulse, WallImpulse<d>& onto,
                 double times = 1) {
  if (!place.shape()) {
    onto.rigid += times * wrench_of<d>(x - place.translation(), impulse);
    return;
  }
  if (onto.vertices.size() == 0) onto.vertices.setZero(d, place.shape()->vertices.cols());
  const Anchor<d> at = anchor_of<d>(*place.shape(), x);
  for (int k = 0; k < d; ++k) onto.vertices.col(at.vertex[k]) += times * at.weight[k] * impulse;
}

/// Force and moment of what acts on a wall: about its reference point, of one that deforms about the world's origin.
template <int d>
Wrench<d> resultant(const WallPlace<d>& place, const WallImpulse<d>& on) {
  if (!place.shape()) return on.rigid;
  Wrench<d> sum = Wrench<d>::Zero();
  for (Eigen::Index v = 0; v < on.vertices.cols(); ++v)
    sum += wrench_of<d>(place.shape()->vertices.col(v), on.vertices.col(v));
  return sum;
}

extern template std::span<const FacetPoint<2>> points_of_facet(const WallShape<2>&, double);
extern template std::span<const FacetPoint<3>> points_of_facet(const WallShape<3>&, double);

}  // namespace splashdown::fluid
