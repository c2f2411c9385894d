// Integrals over edges of the boundary.
#pragma once

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// An edge at a point of its rule: shape functions of its ends and middle, place [m], and the normal to its right, out of the
/// fluid, times the length that the point stands for [m].
struct EdgePoint {
  Eigen::Vector3d N;
  Vec<2> x, normal;
};

/// `add(EdgePoint)` at each point of the rule.
template <class Add>
void at_edge_points(const BoundaryEdge& edge, const Nodes& nodes, Add&& add) {
  Eigen::Matrix<double, 2, 3> x;
  for (int k = 0; k < 3; ++k) x.col(k) = nodes.col(edge.nodes[static_cast<std::size_t>(k)]);
  for (const auto& on : rule<1>()) {
    const Eigen::Vector3d N = shapes<1>(on.at);
    const Vec<2> along = x * shape_slopes<1>(on.at).transpose();
    add(EdgePoint{N, x * N, on.weight * Vec<2>(along.y(), -along.x())});
  }
}

}  // namespace splashdown::ale
