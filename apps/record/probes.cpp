#include "apps/record/probes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/closest_point.hpp"

namespace splashdown::apps {

namespace {

std::size_t slot(int i) { return static_cast<std::size_t>(i); }

/// Barycentric coordinates of the point of a simplex facet nearest to `point`. For triangles the coordinates
/// of the projection are clipped and normalised: exact inside, close enough outside for a distance test.
template <int d>
Eigen::Matrix<double, d, 1> nearest_weights(const std::array<Vec<d>, d>& corners, const Vec<d>& point) {
  const Vec<d - 1> local = weights_in(corners, point);
  Eigen::Matrix<double, d, 1> weights;
  weights << 1 - local.sum(), local;
  weights = weights.cwiseMax(0);
  return weights / weights.sum();
}

/// Chains the facets of an outline, so that each begins where the one before ended.
std::vector<Eigen::Index> chain(const Eigen::Matrix<int, 2, Eigen::Dynamic>& facets) {
  std::vector<Eigen::Index> after(static_cast<std::size_t>(facets.size()), -1);
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    const auto from = slot(facets(0, f));
    if (from >= after.size()) after.resize(from + 1, -1);
    after[from] = f;
  }
  std::vector<Eigen::Index> order;
  for (Eigen::Index f = 0; f >= 0 && static_cast<Eigen::Index>(order.size()) < facets.cols();) {
    order.push_back(f);
    const auto to = slot(facets(1, f));
    f = to < after.size() ? after[to] : -1;
  }
  return order;
}

}  // namespace

template <int d>
std::optional<double> surface_elevation(std::span<const Vec<d>> points, std::span<const Facet<d>> boundary,
                                        const Eigen::Matrix<double, d - 1, 1>& at) {
  std::optional<double> highest;
  for (const auto& facet : boundary) {
    if (facet.wall >= 0) continue;
    const auto corners = corners_of(facet, points);
    Eigen::Matrix<double, d - 1, d - 1> edges;
    for (int k = 1; k < d; ++k)
      edges.col(k - 1) = corners[slot(k)].template head<d - 1>() - corners[0].template head<d - 1>();
    const double area = edges.determinant();
    if (area == 0) continue;  // vertical facet: its neighbours hold the same heights
    const Eigen::Matrix<double, d - 1, 1> local = edges.inverse() * (at - corners[0].template head<d - 1>());
    const double tolerance = 1e-12;  // a line through a node must not slip between two facets
    if (local.minCoeff() < -tolerance || local.sum() > 1 + tolerance) continue;
    double height = corners[0](d - 1);
    for (int k = 1; k < d; ++k) height += local(k - 1) * (corners[slot(k)](d - 1) - corners[0](d - 1));
    if (!highest || height > *highest) highest = height;
  }
  return highest;
}

template <int d>
std::optional<double> wall_pressure(std::span<const Vec<d>> points, std::span<const Facet<d>> boundary,
                                    std::span<const double> pressure, const Vec<d>& point) {
  std::optional<double> found;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& facet : boundary) {
    if (facet.wall < 0) continue;
    const auto corners = corners_of(facet, points);
    const auto weights = nearest_weights<d>(corners, point);
    Vec<d> foot = Vec<d>::Zero();
    double p = 0, size = 0;
    for (std::size_t k = 0; k < d; ++k) {
      const double weight = weights(static_cast<Eigen::Index>(k));
      foot += weight * corners[k];
      p += weight * pressure[slot(facet.nodes[k])];
      size = std::max(size, (corners[k] - corners[0]).norm());
    }
    const double distance = (point - foot).norm();
    if (distance > 0.5 * size || distance >= nearest) continue;
    nearest = distance;
    found = p;
  }
  return found;
}

template <int d>
double patch_force(const WallFacets<d>& wall, std::span<const double> pressure, const PatchRegion<d>& region) {
  const Isometry<d> to_wall = wall.pose.inverse();
  double force = 0;
  for (const auto& facet : wall.boundary) {
    if (facet.wall != wall.wall) continue;
    std::array<Vec<d>, d> corners;
    std::array<double, d> at_corners;
    for (std::size_t k = 0; k < d; ++k) {
      const std::size_t point = slot(facet.nodes[d - 1 - k]);  // turned round: the hull's sense, not the fluid's
      corners[k] = to_wall * wall.points[point];
      at_corners[k] = pressure[point];
    }
    force += integrate<d>(region, corners, at_corners).force;
  }
  return force;
}

template <int d>
SurfaceRuler<d>::SurfaceRuler(const Surface<d>& surface, const Isometry<d>& initial)
    : surface_(surface), start_(static_cast<std::size_t>(surface.facets.cols()), 0.0) {
  const auto& [vertices, facets] = surface_;
  const Eigen::VectorXd height = (initial * vertices).row(d - 1).transpose();
  Eigen::Index lowest = 0;
  height.minCoeff(&lowest);
  keel_point_ = vertices.col(lowest);
  if constexpr (d == 2) {
    double twice_area = 0;
    for (const Eigen::Index f : chain(facets)) {
      const Vec<2> from = vertices.col(facets(0, f)), to = vertices.col(facets(1, f));
      start_[static_cast<std::size_t>(f)] = length_;
      if (facets(0, f) == lowest) keel_ = length_;
      length_ += (to - from).norm();
      twice_area += from.x() * to.y() - from.y() * to.x();
    }
    orientation_ = twice_area < 0 ? -1 : 1;
    for (Eigen::Index f = 0; f < facets.cols(); ++f) {
      const Vec<2> from = vertices.col(facets(0, f)), to = vertices.col(facets(1, f));
      const double level = 1e-9 * length_;
      if (std::max(height(facets(0, f)), height(facets(1, f))) > height(lowest) + level) continue;
      keel_ = start_[static_cast<std::size_t>(f)] + 0.5 * (to - from).norm();
      break;
    }
  }
}

template <int d>
double SurfaceRuler<d>::distance(const Vec<d>& point) const {
  if constexpr (d == 2) {
    double along = 0, nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index f = 0; f < surface_.facets.cols(); ++f) {
      const std::array<Vec<2>, 2> ends{surface_.vertices.col(surface_.facets(0, f)),
                                       surface_.vertices.col(surface_.facets(1, f))};
      const auto weights = nearest_weights<2>(ends, point);
      const double gap = (weights(0) * ends[0] + weights(1) * ends[1] - point).squaredNorm();
      if (gap >= nearest) continue;
      nearest = gap;
      along = start_[static_cast<std::size_t>(f)] + weights(1) * (ends[1] - ends[0]).norm();
    }
    return orientation_ * std::remainder(along - keel_, length_);
  } else {
    return (point - keel_point_).norm();
  }
}

template <int d>
std::vector<SurfacePressurePoint<d>> surface_pressure(const WallFacets<d>& wall, std::span<const double> pressure,
                                                      std::span<const double> repair, const SurfaceRuler<d>& ruler,
                                                      std::span<const Vec<d>> at_rest) {
  std::vector<int> wetted;
  for (const auto& facet : wall.boundary)
    if (facet.wall == wall.wall) wetted.insert(wetted.end(), facet.nodes.begin(), facet.nodes.end());
  std::ranges::sort(wetted);
  wetted.erase(std::unique(wetted.begin(), wetted.end()), wetted.end());

  std::vector<SurfacePressurePoint<d>> points;
  points.reserve(wetted.size());
  const Isometry<d> to_wall = wall.pose.inverse();
  for (const int at : wetted) {
    const Vec<d>& x = wall.points[slot(at)];
    const Vec<d> on_wall = at_rest.empty() ? Vec<d>(to_wall * x) : at_rest[slot(at)];
    points.push_back(
        {x, ruler.distance(on_wall), pressure[slot(at)], repair.empty() ? 0.0 : repair[slot(at)], on_wall});
  }
  std::ranges::stable_sort(points, {}, &SurfacePressurePoint<d>::s);
  return points;
}

#define SPLASHDOWN_INSTANTIATE(d)                                                                                    \
  template std::optional<double> surface_elevation<d>(std::span<const Vec<d>>, std::span<const Facet<d>>,            \
                                                      const Eigen::Matrix<double, d - 1, 1>&);                       \
  template std::optional<double> wall_pressure<d>(std::span<const Vec<d>>, std::span<const Facet<d>>,                \
                                                  std::span<const double>, const Vec<d>&);                           \
  template double patch_force<d>(const WallFacets<d>&, std::span<const double>, const PatchRegion<d>&);              \
  template class SurfaceRuler<d>;                                                                                    \
  template std::vector<SurfacePressurePoint<d>> surface_pressure<d>(const WallFacets<d>&, std::span<const double>,   \
                                                                    std::span<const double>, const SurfaceRuler<d>&, \
                                                                    std::span<const Vec<d>>);
SPLASHDOWN_INSTANTIATE(2)
SPLASHDOWN_INSTANTIATE(3)
#undef SPLASHDOWN_INSTANTIATE

}  // namespace splashdown::apps
