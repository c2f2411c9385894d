#include "fluid/wall.hpp"

#include <cmath>
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
  double enclosed = 0;
  for (int f = 0; f < facets.cols(); ++f) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = vertices.col(facets(k, f));
    enclosed += corner[0].dot(area_vector(corner));
  }
  turned_inside_out_ = enclosed < 0;
  tiny_ = 1e-9 * box_.diagonal().norm();
}

template <int d>
typename Wall<d>::Near Wall<d>::nearest(const Isometry<d>& pose, const Vec<d>& x, double reach) const {
  const Vec<d> local = pose.inverse() * x;
  const auto hit = tree_.nearest(local, reach);
  if (hit.facet < 0) return {x, reach, -1};
  // The side is taken from the normals of all facets that meet at the closest point.
  Vec<d> normal = normal_.col(hit.facet);
  int vertex = -1;
  for (int k = 0; k < d; ++k) {
    const int v = spec_.surface.facets(k, hit.facet);
    const Vec<d> corner = spec_.surface.vertices.col(v);
    if ((corner - hit.point).norm() > tiny_) continue;
    normal = vertex_normal_.col(v);
    if (is_sharp_[v]) vertex = v;
  }
  const double side = (local - hit.point).dot(normal) < 0 ? -1.0 : 1.0;
  return {pose * hit.point, side * std::sqrt(hit.squared_distance), vertex};
}

template <int d>
double Wall<d>::distance_unsigned(const Isometry<d>& pose, const Vec<d>& x, double reach) const {
  return std::sqrt(tree_.nearest(pose.inverse() * x, reach).squared_distance);
}

template class Wall<2>;
template class Wall<3>;

}  // namespace splashdown::fluid
