#include "fluid/ale/mesh/field_on_mesh.hpp"

#include <Eigen/LU>
#include <limits>

#include "core/simplices/split.hpp"

namespace splashdown::ale {

PlacesInMesh::PlacesInMesh(const FlowMesh& mesh, const Nodes& x) : mesh_(mesh), pieces_(straight_pieces(mesh.cells)) {
  for (const auto& place : x.colwise()) points_.emplace_back(place);
  finder_.place(pieces_, points_);
}

PieceFinder::Place PlacesInMesh::nearest(const Vec<2>& point) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    Vec<2> middle = Vec<2>::Zero();
    for (const int a : pieces_[p]) middle += points_[static_cast<std::size_t>(a)] / 3;
    if (const double away = (middle - point).squaredNorm(); away < least) {
      least = away;
      best = p;
    }
  }
  return {best, Barycentric<2>::Constant(1. / 3)};
}

/// Newton's method for the place in a curved cell, from that in the straight piece of it.
PlacesInMesh::Place PlacesInMesh::find(const Vec<2>& point) const {
  constexpr int most = 20;
  constexpr double beyond = 0.2;
  const auto found = finder_.find(point);
  const auto piece = found ? *found : nearest(point);
  constexpr auto parts = cell_parts<2>();
  const auto& cell = mesh_.cells[piece.piece / parts.size()];
  const auto& part = parts[piece.piece % parts.size()];
  Barycentric<2> L = Barycentric<2>::Zero();
  for (std::size_t k = 0; k < 3; ++k) L += piece.at[static_cast<Eigen::Index>(k)] * node_place<2>(part[k]);
  Eigen::Matrix<double, 2, 6> x;
  for (int a = 0; a < 6; ++a) x.col(a) = points_[static_cast<std::size_t>(cell[static_cast<std::size_t>(a)])];
  for (int k = 0; k < most; ++k) {
    const Mat<2> J = x * shape_slopes<2>(L).transpose();
    const Vec<2> change = J.inverse() * (point - x * shapes<2>(L));
    L += Barycentric<2>(-change.sum(), change[0], change[1]);
    L = L.cwiseMax(-beyond).cwiseMin(1 + beyond);
    L /= L.sum();
    if (change.norm() < 1e-13) break;
  }
  return {&cell, L};
}

Vec<2> PlacesInMesh::quadratic(const Nodes& values, const Vec<2>& point) const {
  const auto [cell, L] = find(point);
  const auto N = shapes<2>(L);
  Vec<2> sum = Vec<2>::Zero();
  for (int a = 0; a < 6; ++a) sum += N[a] * values.col((*cell)[static_cast<std::size_t>(a)]);
  return sum;
}

double PlacesInMesh::linear(const Eigen::VectorXd& values, const Vec<2>& point) const {
  const auto [cell, L] = find(point);
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += L[k] * values[(*cell)[static_cast<std::size_t>(k)]];
  return sum;
}

}  // namespace splashdown::ale
