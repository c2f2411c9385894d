#include "fluid/ale/mesh/extension.hpp"

#include <cmath>
#include <numeric>

#include "core/geometry.hpp"

namespace splashdown::ale {

Extension::Extension(const FlowMesh& mesh, double stiffening) {
  const auto nodes = static_cast<std::size_t>(mesh.size());
  is_given_.assign(nodes, 0);
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes) is_given_[static_cast<std::size_t>(a)] = 1;
  free_.assign(static_cast<std::size_t>(mesh.corners), -1);
  int count = 0;
  for (std::size_t a = 0; a < free_.size(); ++a)
    if (!is_given_[a]) free_[a] = count++;
  std::vector<char> is_met(nodes, 0);
  std::vector<VolumeGradients<2>> gradients;  // times the area
  std::vector<double> areas;
  for (const auto& cell : mesh.cells) {
    for (std::size_t e = 0; e < 3; ++e) {
      const auto middle = static_cast<std::size_t>(cell[3 + e]);
      if (is_given_[middle] || is_met[middle]) continue;
      is_met[middle] = 1;
      middles_.push_back({cell[3 + e], cell[static_cast<std::size_t>(cell_edges[e][0])],
                          cell[static_cast<std::size_t>(cell_edges[e][1])]});
    }
    const auto corner = [&](int k) { return Vec<2>(mesh.nodes.col(cell[static_cast<std::size_t>(k)])); };
    areas.push_back(volume<2>(corner));
    gradients.push_back(volume_gradients<2>(corner));
  }
  const double mean = std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
  std::vector<Eigen::Triplet<double>> inner, outer;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Eigen::Matrix3d K =
        std::pow(mean / areas[c], stiffening) / areas[c] * gradients[c].transpose() * gradients[c];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int column = mesh.cells[c][static_cast<std::size_t>(j)];
        const int at = free_[static_cast<std::size_t>(mesh.cells[c][static_cast<std::size_t>(i)])],
                  with = free_[static_cast<std::size_t>(column)];
        if (at < 0) continue;
        if (with >= 0)
          inner.emplace_back(at, with, K(i, j));
        else
          outer.emplace_back(at, column, K(i, j));
      }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(inner.begin(), inner.end());
  coupling_.resize(count, mesh.corners);
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
