// Points of a surface, by the vertices that carry them along where the surface deforms.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/closest_point.hpp"
#include "core/facet_tree.hpp"
#include "core/wall_vector.hpp"

namespace splashdown {

/// A point of a facet: its corners, with their weights.
template <int d>
struct Anchor {
  std::array<int, d> vertex;     ///< corners of the facet
  std::array<double, d> weight;  ///< sum to 1, none negative but for roundoff

  /// What is linear between vertices, there.
  Vec<d> interpolate(const AtVertices<d>& values) const {
    Vec<d> there = Vec<d>::Zero();
    for (int k = 0; k < d; ++k) there += weight[k] * values.col(vertex[k]);
    return there;
  }
};

/// Of the point of a surface that is nearest to x [m]; `tree`: of its facets.
template <int d>
Anchor<d> anchor_on(const AtVertices<d>& vertices, const Eigen::Matrix<int, d, Eigen::Dynamic>& facets,
                    const FacetTree<d>& tree, const Vec<d>& x) {
  const auto hit = tree.nearest(x, std::numeric_limits<double>::max());
  const int facet = std::max(0, hit.facet);  // x is not finite: any
  Anchor<d> anchor;
  std::array<Vec<d>, d> corner;
  for (int k = 0; k < d; ++k) {
    anchor.vertex[k] = facets(k, facet);
    corner[k] = vertices.col(anchor.vertex[k]);
  }
  const auto weights = weights_in(corner, hit.facet < 0 ? corner[0] : hit.point);
  anchor.weight[0] = 1 - weights.sum();
  for (int k = 1; k < d; ++k) anchor.weight[k] = weights[k - 1];
  return anchor;
}

}  // namespace splashdown
