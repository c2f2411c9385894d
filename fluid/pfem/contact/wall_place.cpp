#include "fluid/pfem/contact/wall_place.hpp"

#include <algorithm>
#include <limits>

namespace splashdown::fluid {
namespace {

// Barycentric coordinates of the point of a segment that is nearest to x, and of a point x of a triangle's plane.
std::array<double, 2> weights_on(const std::array<Vec<2>, 2>& at, const Vec<2>& x) {
  const Vec<2> along = at[1] - at[0];
  const double length = along.squaredNorm(), share = length > 0 ? along.dot(x - at[0]) / length : 0.0;
  const double second = std::clamp(share, 0.0, 1.0);
  return {1 - second, second};
}
std::array<double, 3> weights_on(const std::array<Vec<3>, 3>& at, const Vec<3>& x) {
  const Vec<3> area = area_vector(at);
  const double squared = area.squaredNorm();
  std::array<double, 3> weight{1, 0, 0};
  if (!(squared > 0)) return weight;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const std::array<Vec<3>, 3> part{x, at[(k + 1) % 3], at[(k + 2) % 3]};
    sum += weight[k] = std::max(0.0, area_vector(part).dot(area) / squared);
  }
  for (double& w : weight) w /= sum;
  return weight;
}

}  // namespace

template <int d>
Anchor<d> anchor_of(const WallShape<d>& shape, const Vec<d>& x) {
  const auto hit = shape.tree.nearest(x, std::numeric_limits<double>::max());
  const int facet = std::max(0, hit.facet);  // x is not finite: any
  Anchor<d> anchor;
  std::array<Vec<d>, d> corner;
  for (int k = 0; k < d; ++k) {
    anchor.vertex[k] = (*shape.facets)(k, facet);
    corner[k] = shape.vertices.col(anchor.vertex[k]);
  }
  anchor.weight = weights_on(corner, hit.facet < 0 ? corner[0] : hit.point);
  return anchor;
}

template Anchor<2> anchor_of(const WallShape<2>&, const Vec<2>&);
template Anchor<3> anchor_of(const WallShape<3>&, const Vec<3>&);

}  // namespace splashdown::fluid
