#include "fluid/ale/mesh/extension.hpp"

#include <cmath>

#include "fluid/ale/mesh/cell_rule.hpp"

namespace splashdown::ale {

Extension::Extension(const FlowMesh& mesh, double stiffening) {
  const auto nodes = static_cast<std::size_t>(mesh.size());
  is_given_.assign(nodes, 0);
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes) is_given_[static_cast<std::size_t>(a)] = 1;
  free_.assign(nodes, -1);
  int count = 0;
  for (std::size_t a = 0; a < nodes; ++a)
    if (!is_given_[a]) free_[a] = count++;
  std::vector<Eigen::Matrix<double, 6, 6>> stiffness;
  std::vector<double> areas;
  double total = 0;
  for (const auto& cell : mesh.cells) {
    Eigen::Matrix<double, 2, 6> x;
    for (int a = 0; a < 6; ++a) x.col(a) = mesh.nodes.col(cell[static_cast<std::size_t>(a)]);
    auto& K = stiffness.emplace_back(Eigen::Matrix<double, 6, 6>::Zero());
    double area = 0;
    for (const auto& point : cell_rule()) {
      const Mat<2> J = x * point.slopes.transpose();
      const Eigen::Matrix<double, 2, 6> g = J.inverse().transpose() * point.slopes;
      const double share = point.weight * J.determinant();
      K += share * g.transpose() * g;
      area += share;
    }
    areas.push_back(area);
    total += area;
  }
  const double mean = total / static_cast<double>(mesh.cells.size());
  std::vector<Eigen::Triplet<double>> inner, outer;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double s = std::pow(mean / areas[c], stiffening);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const int row = mesh.cells[c][static_cast<std::size_t>(i)], column = mesh.cells[c][static_cast<std::size_t>(j)];
        const int at = free_[static_cast<std::size_t>(row)], with = free_[static_cast<std::size_t>(column)];
        if (at < 0) continue;
        if (with >= 0)
          inner.emplace_back(at, with, s * stiffness[c](i, j));
        else
          outer.emplace_back(at, column, s * stiffness[c](i, j));
      }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(inner.begin(), inner.end());
  coupling_.resize(count, mesh.size());
  coupling_.setFromTriplets(outer.begin(), outer.end());
  factor_.compute(matrix);
}

void Extension::extend(Nodes& values) const {
  const Eigen::MatrixXd given = values.transpose();
  const Eigen::MatrixXd found = factor_.solve(-(coupling_ * given));
  for (std::size_t a = 0; a < free_.size(); ++a)
    if (free_[a] >= 0) values.col(static_cast<Eigen::Index>(a)) = found.row(free_[a]).transpose();
}

}  // namespace splashdown::ale
