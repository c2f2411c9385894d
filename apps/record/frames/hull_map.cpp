#include "apps/record/frames/hull_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/facet_tree.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {

namespace {

using Edge = std::pair<int, int>;

template <int d>
using FacetCorners = std::array<int, d>;

template <int d>
std::vector<FacetCorners<d>> facets_of(const Surface<d>& surface) {
  std::vector<FacetCorners<d>> facets(static_cast<std::size_t>(surface.facets.cols()));
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::size_t k = 0; k < d; ++k)
      facets[f][k] = surface.facets(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(f));
  return facets;
}

/// Halves a facet at its longest edge that has a middle, then its halves.
template <int d>
void divide(const FacetCorners<d>& facet, const std::map<Edge, int>& middles, const std::vector<Vec<d>>& x,
            std::vector<FacetCorners<d>>& pieces) {
  double longest = -1;
  std::array<std::size_t, 2> at{};
  int middle = -1;
  for (std::size_t k = 0; k < d; ++k)
    for (std::size_t l = k + 1; l < d; ++l) {
      const auto found = middles.find(std::minmax(int{facet[k]}, int{facet[l]}));
      if (found == middles.end()) continue;
      const double length = (x[static_cast<std::size_t>(facet[k])] - x[static_cast<std::size_t>(facet[l])]).norm();
      if (length > longest) longest = length, at = {k, l}, middle = found->second;
    }
  if (middle < 0) return pieces.push_back(facet);
  for (const std::size_t k : at) {
    auto half = facet;
    half[k] = middle;
    divide<d>(half, middles, x, pieces);
  }
}

template <int d>
struct Footprint {
  std::array<double, d> weight;  ///< barycentric, of the foot on the facet's plane
  double distance;
};

template <int d>
Footprint<d> footprint(const std::array<Vec<d>, d>& corner, const Vec<d>& point) {
  Eigen::Matrix<double, d, d - 1> edges;
  for (int k = 1; k < d; ++k) edges.col(k - 1) = corner[static_cast<std::size_t>(k)] - corner[0];
  const Eigen::Matrix<double, d - 1, d - 1> gram = edges.transpose() * edges;
  const Eigen::Matrix<double, d - 1, 1> local = gram.inverse() * (edges.transpose() * (point - corner[0]));
  Footprint<d> foot;
  foot.weight[0] = 1 - local.sum();
  for (int k = 1; k < d; ++k) foot.weight[static_cast<std::size_t>(k)] = local(k - 1);
  foot.distance = (corner[0] + edges * local - point).norm();
  return foot;
}

}  // namespace

template <int d>
Surface<d> refined(Surface<d> surface, double longest) {
  std::vector<Vec<d>> x;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) x.push_back(surface.vertices.col(i));
  auto facets = facets_of<d>(surface);
  for (;;) {
    std::map<Edge, int> middles;
    for (const auto& facet : facets)
      for (std::size_t k = 0; k < d; ++k)
        for (std::size_t l = k + 1; l < d; ++l) {
          const Vec<d>&a = x[static_cast<std::size_t>(facet[k])], &b = x[static_cast<std::size_t>(facet[l])];
          if (!((a - b).norm() > longest)) continue;
          const Vec<d> middle = 0.5 * (a + b);
          const auto [place, is_new] =
              middles.try_emplace(std::minmax(int{facet[k]}, int{facet[l]}), static_cast<int>(x.size()));
          if (is_new) x.push_back(middle);
        }
    if (middles.empty()) break;
    std::vector<FacetCorners<d>> pieces;
    for (const auto& facet : facets) divide<d>(facet, middles, x, pieces);
    facets = std::move(pieces);
  }
  surface.vertices.resize(d, static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) surface.vertices.col(static_cast<Eigen::Index>(i)) = x[i];
  surface.facets.resize(d, static_cast<Eigen::Index>(facets.size()));
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::size_t k = 0; k < d; ++k)
      surface.facets(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(f)) = facets[f][k];
  return surface;
}

/// Vertices of a surface near a point.
template <int d>
class HullMap<d>::Locator {
 public:
  explicit Locator(const Surface<d>& surface) : surface_(surface), tree_(surface.vertices, surface.facets) {}
  /// All that are within `radius` of x, in ascending order.
  const std::vector<int>& within(double radius, const Vec<d>& x) {
    found_.clear();
    const Vec<d> reach = Vec<d>::Constant(radius);
    for (const int facet : tree_.meeting({x - reach, x + reach}))
      found_.insert(found_.end(), surface_.facets.col(facet).begin(), surface_.facets.col(facet).end());
    std::ranges::sort(found_);
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    std::erase_if(found_, [&](int vertex) { return !((surface_.vertices.col(vertex) - x).norm() <= radius); });
    return found_;
  }

 private:
  const Surface<d> surface_;
  FacetTree<d> tree_;
  std::vector<int> found_;
};

template <int d>
HullMap<d>::HullMap(const Surface<d>& surface, double size)
    : surface_(refined<d>(surface, size)), locator_(std::make_unique<Locator>(surface_)) {
  const auto count = static_cast<std::size_t>(surface_.vertices.cols());
  pressure_.assign(count, 0);
  impulse_.assign(count, 0);
  time_.assign(count, std::numeric_limits<double>::quiet_NaN());
  normal_.assign(count, Vec<d>::Zero());
  for (const auto& facet : facets_of<d>(surface_)) {
    std::array<Vec<d>, d> corner;
    for (std::size_t k = 0; k < d; ++k) corner[k] = surface_.vertices.col(facet[k]);
    for (const int vertex : facet) normal_[static_cast<std::size_t>(vertex)] += area_vector(corner);
  }
  for (auto& normal : normal_) normal.normalize();
}

template <int d>
HullMap<d>::~HullMap() = default;
template <int d>
HullMap<d>::HullMap(HullMap&&) noexcept = default;

template <int d>
void HullMap<d>::add(const WallFacets<d>& wall, std::span<const double> pressure, std::span<const double> repair,
                     const Kick& kick) {
  // Facets are chords: beside a convex edge there is a gap of sagitta times angle, h/8 (h/R)^2 < rim h for h < R/4.
  constexpr double rim = 0.01;
  // Cosine of the angle between normals: a point beside a right-angled edge does not face as the other side does, the edge
  // of a blade of 12 degrees, whose normal is that of both sides together, faces like either.
  constexpr double alike = 0.1;
  const Isometry<d> to_wall = wall.pose.inverse();
  wet_.assign(pressure_.size(), 0);
  for (const auto& facet : wall.boundary) {
    if (facet.wall != wall.wall) continue;
    std::array<Vec<d>, d> corner;
    Vec<d> middle = Vec<d>::Zero();
    for (std::size_t k = 0; k < d; ++k) {
      corner[k] = to_wall * wall.points[static_cast<std::size_t>(facet.nodes[k])];
      middle += corner[k] / d;
    }
    const Vec<d> out_of_fluid = area_vector(corner);
    double reach = 0, size = 0;
    for (std::size_t k = 0; k < d; ++k) {
      reach = std::max(reach, (corner[k] - middle).norm());
      size = std::max(size, (corner[k] - corner[0]).norm());
    }
    for (const int near : locator_->within(std::hypot(reach, 0.5 * size), middle)) {
      const auto point = static_cast<std::size_t>(near);
      if (!(normal_[point].dot(out_of_fluid) < -alike * out_of_fluid.norm())) continue;
      const auto foot = footprint<d>(corner, surface_.vertices.col(near));
      if (!(foot.distance <= 0.5 * size) || *std::ranges::min_element(foot.weight) < -rim) continue;
      const auto at_foot = [&](std::span<const double> values) {
        double sum = 0;
        for (std::size_t k = 0; k < d; ++k) sum += foot.weight[k] * values[static_cast<std::size_t>(facet.nodes[k])];
        return sum;
      };
      const double p = at_foot(pressure);
      if (!std::isfinite(p)) continue;
      // On an edge of the mesh the facets that meet there say the same.
      if (!std::exchange(wet_[point], 1))
        impulse_[point] += kick.length() * (p + (repair.empty() ? 0.0 : at_foot(repair)));
      if (std::isfinite(time_[point]) && p <= pressure_[point]) continue;
      pressure_[point] = p;
      time_[point] = kick.time;
    }
  }
}

template Surface<2> refined<2>(Surface<2>, double);
template Surface<3> refined<3>(Surface<3>, double);
template class HullMap<2>;
template class HullMap<3>;

}  // namespace splashdown::apps
