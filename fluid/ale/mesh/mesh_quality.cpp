#include "fluid/ale/mesh/mesh_quality.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "fluid/ale/mesh/cell_rule.hpp"

namespace splashdown::ale {
namespace {

using CellPlaces = Eigen::Matrix<double, 2, 6>;

CellPlaces places_in(const Nodes& x, const Cell& cell) {
  CellPlaces all;
  for (int a = 0; a < 6; ++a) all.col(a) = x.col(cell[static_cast<std::size_t>(a)]);
  return all;
}

double least_determinant(const CellPlaces& x) {
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const CellPoint& point) {
    least = std::min(least, Mat<2>(x * point.slopes.transpose()).determinant());
  };
  for (int i = 0; i < 3; ++i) look_at(cell_point(Barycentric<2>::Unit(i), 0.5));
  for (const auto& point : cell_rule()) look_at(point);
  return least;
}

Mat<2> straight_edges(const CellPlaces& x) {
  Mat<2> edges;
  edges << x.col(1) - x.col(0), x.col(2) - x.col(0);
  return edges;
}

}  // namespace

MeshQuality::MeshQuality(const FlowMesh& mesh) : cells_(mesh.cells) {
  for (const auto& cell : cells_) {
    const CellPlaces x = places_in(mesh.nodes, cell);
    inverse_.emplace_back(straight_edges(x).inverse());
    made_.push_back(least_determinant(x));
  }
}

double MeshQuality::least(const Nodes& x) const {
  double least = 1;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const CellPlaces now = places_in(x, cells_[c]);
    const Mat<2> F = straight_edges(now) * inverse_[c];
    least = std::min({least, least_determinant(now) / made_[c], 2 * F.determinant() / F.squaredNorm()});
  }
  return least;
}

std::vector<double> evenness(const FlowMesh& mesh) {
  const auto middle = cell_point(Barycentric<2>::Constant(1. / 3), 0.5);
  std::vector<double> all;
  for (const auto& cell : mesh.cells) {
    const CellPlaces x = places_in(mesh.nodes, cell);
    const double in_middle = Mat<2>(x * middle.slopes.transpose()).determinant();
    all.push_back(in_middle > 0 ? least_determinant(x) / in_middle : -1);
  }
  return all;
}

}  // namespace splashdown::ale
