#include "fluid/ale/mesh/extension.hpp"

#include <cmath>
#include <numeric>

#include "core/geometry.hpp"

namespace splashdown::ale {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Linear elements on corners: the stiffness of div(s grad d) and the lumped mass, a cell's area shared out among its corners.
struct LinearElements {
  Sparse stiffness;
  Eigen::VectorXd mass;
};

LinearElements linear_elements(const FlowMesh& mesh, double stiffening) {
  std::vector<VolumeGradients<2>> gradients;  // times the area
  std::vector<double> areas;
  for (const auto& cell : mesh.cells) {
    const auto corner = [&](int k) { return Vec<2>(mesh.nodes.col(cell[static_cast<std::size_t>(k)])); };
    areas.push_back(volume<2>(corner));
    gradients.push_back(volume_gradients<2>(corner));
  }
  const double mean = std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
  LinearElements all{Sparse(mesh.corners, mesh.corners), Eigen::VectorXd::Zero(mesh.corners)};
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Eigen::Matrix3d K =
        std::pow(mean / areas[c], stiffening) / areas[c] * gradients[c].transpose() * gradients[c];
    for (int i = 0; i < 3; ++i) {
      const int row = mesh.cells[c][static_cast<std::size_t>(i)];
      all.mass[row] += areas[c] / 3;
      for (int j = 0; j < 3; ++j) entries.emplace_back(row, mesh.cells[c][static_cast<std::size_t>(j)], K(i, j));
    }
  }
  all.stiffness.setFromTriplets(entries.begin(), entries.end());
  return all;
}

/// Of all corners. Twice the Laplacian, with e = -div grad d at all corners between: those of walls and sides let no slope
/// through (Ciarlet & Raviart 1974).
Sparse matrix_of(const FlowMesh& mesh, ExtensionLaw law) {
  constexpr double stiffening = 1.5;
  if (law == ExtensionLaw::laplace) return linear_elements(mesh, stiffening).stiffness;
  const auto [K, mass] = linear_elements(mesh, 0);
  const Eigen::VectorXd by_mass = mass.cwiseInverse();
  return K * by_mass.asDiagonal() * K;
}

}  // namespace

void Extension::find_followers(const FlowMesh& mesh) {
  const auto nodes = static_cast<std::size_t>(mesh.size());
  is_given_.assign(nodes, 0);
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes) is_given_[static_cast<std::size_t>(a)] = 1;
  free_.assign(static_cast<std::size_t>(mesh.corners), -1);
  int count = 0;
  for (std::size_t a = 0; a < free_.size(); ++a)
    if (!is_given_[a]) free_[a] = count++;
  coupling_.resize(count, mesh.corners);
  std::vector<char> is_met(nodes, 0);
  for (const auto& cell : mesh.cells)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto middle = static_cast<std::size_t>(cell[3 + e]);
      if (is_given_[middle] || is_met[middle]) continue;
      is_met[middle] = 1;
      middles_.push_back({cell[3 + e], cell[static_cast<std::size_t>(cell_edges[e][0])],
                          cell[static_cast<std::size_t>(cell_edges[e][1])]});
    }
}

Extension::Extension(const FlowMesh& mesh, ExtensionLaw law) {
  find_followers(mesh);
  const Sparse all = matrix_of(mesh, law);
  std::vector<Eigen::Triplet<double>> inner, outer;
  for (int column = 0; column < all.outerSize(); ++column)
    for (Sparse::InnerIterator entry(all, column); entry; ++entry) {
      const int at = free_[static_cast<std::size_t>(entry.row())], with = free_[static_cast<std::size_t>(column)];
      if (at < 0) continue;
      if (with >= 0)
        inner.emplace_back(at, with, entry.value());
      else
        outer.emplace_back(at, column, entry.value());
    }
  Sparse matrix(coupling_.rows(), coupling_.rows());
  matrix.setFromTriplets(inner.begin(), inner.end());
  coupling_.setFromTriplets(outer.begin(), outer.end());
  factor_.compute(matrix);
}

void Extension::extend(Nodes& values) const {
  const Eigen::MatrixXd given = values.leftCols(coupling_.cols()).transpose();
  const Eigen::MatrixXd found = factor_.solve(-(coupling_ * given));
  for (std::size_t a = 0; a < free_.size(); ++a)
    if (free_[a] >= 0) values.col(static_cast<Eigen::Index>(a)) = found.row(free_[a]).transpose();
  for (const auto& [middle, from, to] : middles_) values.col(middle) = 0.5 * (values.col(from) + values.col(to));
}

}  // namespace splashdown::ale
