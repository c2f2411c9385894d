#include "fluid/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fluid/geometry.hpp"

namespace splashdown::fluid {

template <int d>
Wall<d>::Wall(const WallSpec<d>& spec)
    : spec_(spec),
      tree_(spec.surface.vertices, spec.surface.facets),
      normal_(d, spec.surface.facets.cols()),
      vertex_normal_(d, spec.surface.vertices.cols()),
      facets_of_(spec.surface.vertices.cols()),
      is_sharp_(spec.surface.vertices.cols(), 0) {
  const auto& vertices = spec_.surface.vertices;
  const auto& facets = spec_.surface.facets;
  vertex_normal_.setZero();
  for (int f = 0; f < facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = vertices.col(facets(k, f));
    normal_.col(f) = area_vector(corner).normalized();
    for (int k = 0; k < d; ++k) {
      vertex_normal_.col(facets(k, f)) += normal_.col(f);
      facets_of_[facets(k, f)].push_back(f);
    }
  }
  // A crease of more than 30 degrees is an edge of the body, less is a facet of a curved surface.
  const double crease = std::cos(30.0 * std::numbers::pi / 180.0);
  for (int v = 0; v < vertices.cols(); ++v) {
    box_.extend(vertices.col(v));
    for (int f : facets_of_[v])
      for (int g : facets_of_[v])
        if (normal_.col(f).dot(normal_.col(g)) < crease) is_sharp_[v] = 1;
    if (is_sharp_[v]) sharp_.push_back(v);
  }
  find_patches(crease);
  find_bends();
  double enclosed = 0;
  for (int f = 0; f < facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = vertices.col(facets(k, f));
    enclosed += corner[0].dot(area_vector(corner));
  }
  turned_inside_out_ = enclosed < 0;
  tiny_ = 1e-9 * box_.diagonal().norm();
}

// Facets that share an edge without a crease belong together.
template <int d>
void Wall<d>::find_patches(double crease) {
  const auto& facets = spec_.surface.facets;
  auto neighbours = [&](int f, int g) {
    int shared = 0;
    for (int a = 0; a < d; ++a)
      for (int b = 0; b < d; ++b) shared += facets(a, f) == facets(b, g);
    return shared == d - 1 && normal_.col(f).dot(normal_.col(g)) >= crease;
  };
  patch_of_.assign(facets.cols(), -1);
  for (int seed = 0; seed < facets.cols(); ++seed) {
    if (patch_of_[seed] >= 0) continue;
    const int patch = static_cast<int>(patch_facets_.size());
    std::vector<int> members{seed};
    patch_of_[seed] = patch;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (int k = 0; k < d; ++k)
        for (int g : facets_of_[facets(k, members[i])])
          if (patch_of_[g] < 0 && neighbours(members[i], g)) patch_of_[g] = patch, members.push_back(g);
    Eigen::Matrix<int, d, Eigen::Dynamic> own(d, members.size());
    for (std::size_t i = 0; i < members.size(); ++i) own.col(i) = facets.col(members[i]);
    patch_tree_.emplace_back(spec_.surface.vertices, std::move(own));
    patch_facets_.push_back(std::move(members));
  }
}

// Curvature along an edge from the normals at its ends, |(n_j - n_i).(x_j - x_i)| / |x_j - x_i|^2. A sharp vertex has no
// normal, so edges that end at one are no curve.
template <int d>
void Wall<d>::find_bends() {
  const auto& vertices = spec_.surface.vertices;
  const auto& facets = spec_.surface.facets;
  std::vector<double> curvature(vertices.cols(), 0.0);
  for (int f = 0; f < facets.cols(); ++f)
    for (int k = 0; k < d; ++k) {
      const int i = facets(k, f), j = facets((k + 1) % d, f);
      if (is_sharp_[i] || is_sharp_[j]) continue;
      const Vec<d> e = vertices.col(j) - vertices.col(i);
      const double along = (vertex_normal_.col(j).normalized() - vertex_normal_.col(i).normalized()).dot(e);
      for (int v : {i, j}) curvature[v] = std::max(curvature[v], std::abs(along) / e.squaredNorm());
    }
  const double straight = 1e-6 / box_.diagonal().norm();  // roundoff of outlines that are subdivided
  for (int v = 0; v < vertices.cols(); ++v)
    if (curvature[v] > straight) bends_.push_back({vertices.col(v), 1 / curvature[v]});
}

template <int d>
typename Wall<d>::Near Wall<d>::near_of(const Isometry<d>& pose, const Vec<d>& local,
                                        const typename FacetTree<d>::Hit& hit, int facet) const {
  // The side is taken from the normals of all facets that meet at the closest point.
  Vec<d> normal = normal_.col(facet);
  int vertex = -1;
  for (int k = 0; k < d; ++k) {
    const int v = spec_.surface.facets(k, facet);
    const Vec<d> corner = spec_.surface.vertices.col(v);
    if ((corner - hit.point).norm() > tiny_) continue;
    normal = vertex_normal_.col(v);
    if (is_sharp_[v]) vertex = v;
  }
  const double side = (local - hit.point).dot(normal) < 0 ? -1.0 : 1.0;
  return {pose * hit.point, pose.linear() * Vec<d>(normal_.col(facet)), side * std::sqrt(hit.squared_distance), patch_of_[facet], vertex};
}

template <int d>
typename Wall<d>::Near Wall<d>::nearest(const Isometry<d>& pose, const Vec<d>& x, double reach) const {
  const Vec<d> local = pose.inverse() * x;
  const auto hit = tree_.nearest(local, reach);
  if (hit.facet < 0) return {x, Vec<d>::Zero(), reach, -1, -1};
  return near_of(pose, local, hit, hit.facet);
}

template <int d>
typename Wall<d>::Near Wall<d>::nearest_on_patch(const Isometry<d>& pose, const Vec<d>& x, int patch) const {
  const Vec<d> local = pose.inverse() * x;
  const auto hit = patch_tree_[patch].nearest(local, std::numeric_limits<double>::max());
  if (hit.facet < 0) return {x, Vec<d>::Zero(), std::numeric_limits<double>::quiet_NaN(), patch, -1};  // x not finite
  return near_of(pose, local, hit, patch_facets_[patch][hit.facet]);
}

template <int d>
double Wall<d>::distance_unsigned(const Isometry<d>& pose, const Vec<d>& x, double reach) const {
  return std::sqrt(tree_.nearest(pose.inverse() * x, reach).squared_distance);
}

template class Wall<2>;
template class Wall<3>;

}  // namespace splashdown::fluid
