// Where two hulls may touch: vertices and curves of one on facets and edges of the other, edges across edges. Internal to the
// rigid-body room.
#pragma once

#include <vector>

#include "core/geometry.hpp"
#include "rigid/body.hpp"
#include "rigid/contact/hull.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

/// A hull in the world.
template <int d>
struct Placed {
  const Hull<d>* hull;
  Isometry<d> pose;
  Eigen::Matrix<double, d, Eigen::Dynamic> x;  // vertices
  Vec<d> low, high;
  double size, moves;  // moves: farthest that its velocity takes a point of it within the step

  /// Where the state says; `dt` [s]: of the step.
  Placed(const Hull<d>& of, const BodyState<d>& state, double dt) : hull(&of), pose(state.pose) {
    x = (pose.linear() * of.surface().vertices).colwise() + pose.translation();
    low = x.rowwise().minCoeff();
    high = x.rowwise().maxCoeff();
    size = (high - low).norm();
    moves =
        dt * (state.velocity.template head<d>().norm() + size * state.velocity.template tail<rotations<d>>().norm());
  }
  /// In the world.
  FacetCorners<d> corners(int facet) const {
    FacetCorners<d> c;
    for (int k = 0; k < d; ++k) c[static_cast<std::size_t>(k)] = x.col(hull->surface().facets(k, facet));
    return c;
  }
  /// A point of the world in the hull's frame.
  Vec<d> seen(const Vec<d>& world) const { return pose.inverse() * world; }
  /// By the box around the hull.
  bool has_near(const Vec<d>& world, double reach) const {
    return ((world - low).array() >= -reach).all() && ((high - world).array() >= -reach).all();
  }
  /// By the boxes around both.
  bool is_near(const Placed& other, double reach) const {
    return ((other.high - low).array() >= -reach).all() && ((high - other.low).array() >= -reach).all();
  }
};

/// Where a hull may be touched: points of both, and how far apart along the normal.
template <int d>
struct Touch {
  Vec<d> point, foot, normal;
  double gap;
  /// Between the two points.
  double distance() const { return (point - foot).norm(); }
};

/// What of a hull may touch another one within reach [m]: vertices, and curves where vertices lie on them.
template <int d>
std::vector<Touch<d>> touches_of_vertices(const Placed<d>& a, const Placed<d>& b, double reach);

/// Convex edges that cross.
std::vector<Touch<3>> touches_of_edges(const Placed<3>& a, const Placed<3>& b, double reach);

/// Whether no neighbour of vertex v reaches farther that way. Of two that reach equally far the first one does.
template <int d>
bool reaches_farthest(const Placed<d>& hull, int v, const Vec<d>& way);

}  // namespace splashdown::rigid
