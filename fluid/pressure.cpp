#include "fluid/pressure.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace splashdown::fluid {
template <int d>
bool PressureEquation<d>::build(const Nodes<d>& nodes, const Mesh<d>& mesh, double density,
                                std::span<const Vec<d>> centres, std::span<const WallResponse<d>> responses) {
  nodes_ = &nodes;
  mesh_ = &mesh;
  unknown_.assign(nodes.size(), -1);
  node_.clear();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!nodes.surface[i] && !nodes.spray[i]) {
      unknown_[i] = static_cast<int>(node_.size());
      node_.push_back(static_cast<int>(i));
    }
  lumped_.assign(nodes.size(), 0.0);
  gradients_.resize(mesh.cells.size());
  per_mass_.resize(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto at = corners(nodes.x, mesh.cells[c]);
    gradients_[c] = volume_gradients<d>(at);
    const double volume = (at(d) - at(0)).dot(gradients_[c].col(d));
    per_mass_[c] = 1 / (density * volume);
    for (int n : mesh.cells[c]) lumped_[n] += volume / (d + 1);
  }
  per_nodal_mass_.resize(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) per_nodal_mass_[i] = 1 / (density * (d + 1) * lumped_[i]);
  wall_modes(centres);
  std::vector<double> inverse_mass;
  for (const auto& response : responses) inverse_mass.push_back(response.laplacian);
  laplacian_.build(nodes, mesh, unknown_, inverse_mass);
  assemble();
  if (size() == 0) return true;
  if (!factored()) return false;

  responding_.clear();
  for (std::size_t w = 0; w < responses.size(); ++w)
    if (!responses[w].rigid.isZero(0) && !modes_[w].empty()) responding_.push_back(w);
  constexpr int m = freedoms<d>;
  const int columns = static_cast<int>(responding_.size()) * m;
  Y_.setZero(size(), columns);
  C_.setZero(columns, columns);
  for (std::size_t k = 0; k < responding_.size(); ++k) {
    for (const Mode& mode : modes_[responding_[k]]) Y_.row(mode.unknown).segment(k * m, m) += mode.row.transpose();
    C_.block(k * m, k * m, m, m) = responses[responding_[k]].rigid;
  }
  if (columns == 0) return true;
  if (!solver_.solve({Y_.data(), static_cast<std::size_t>(Y_.size())}, columns)) return false;
  added_mass_.setZero(columns, columns);
  for (std::size_t k = 0; k < responding_.size(); ++k)
    for (const Mode& mode : modes_[responding_[k]])
      added_mass_.middleRows(k * m, m) += mode.row * Y_.row(mode.unknown);
  // (1 + C G)^-1 C = R (1 + R^T G R)^-1 R^T with C = R R^T: symmetric, and exact to roundoff for bodies of no mass.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(C_);
  const Eigen::MatrixXd R =
      spectrum.eigenvectors() * spectrum.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  const Eigen::MatrixXd inner = Eigen::MatrixXd::Identity(columns, columns) + R.transpose() * added_mass_ * R;
  elimination_ = R * inner.selfadjointView<Eigen::Lower>().ldlt().solve(R.transpose());
  return true;
}

template <int d>
void PressureEquation<d>::wall_modes(std::span<const Vec<d>> centres) {
  modes_.resize(centres.size());
  for (auto& m : modes_) m.clear();
  for (const auto& f : mesh_->boundary) {
    if (f.wall < 0) continue;
    // int N_a n dA with the arm varying linearly along the facet: consistent facet mass matrix.
    const Vec<d> area = area_vector_of<d>(f, nodes_->x);
    Vec<d> sum = Vec<d>::Zero();
    for (int n : f.nodes) sum += nodes_->x[n] - centres[f.wall];
    for (int n : f.nodes) {
      if (unknown_[n] < 0) continue;
      const Vec<d> arm = (sum + nodes_->x[n] - centres[f.wall]) / (d + 1);
      modes_[f.wall].push_back({unknown_[n], wrench_of<d>(arm, area / d)});
    }
  }
}

// Liquid that walls enclose on all sides has no free surface to fix its pressure: its block is singular, and
// a shift far below the discretisation error makes it definite.
template <int d>
bool PressureEquation<d>::factored() {
  if (solver_.factor(matrix_)) return true;
  constexpr double shift = 1e-9;
  for (int i = 0; i < size(); ++i) matrix_.value[matrix_.column_start[i]] *= 1 + shift;
  return solver_.factor(matrix_);
}

template <int d>
void PressureEquation<d>::assemble() {
  assembly_.build(mesh_->cells, unknown_, size(), [&](int c, int a, int b) {
    return gradients_[c].col(a).dot(gradients_[c].col(b)) * per_mass_[c];
  });
  matrix_.column_start.swap(assembly_.column_start);
  matrix_.row.swap(assembly_.row);
  matrix_.value.swap(assembly_.value);
  laplacian_.add_to(matrix_);
}

template <int d>
void PressureEquation<d>::flux_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> v,
                                        std::span<const Twist<d>> s, std::span<const Vec<d>> centres,
                                        std::vector<double>& r) const {
  r.assign(size(), 0.0);
  for (const auto& cell : mesh_->cells) {
    const auto g = volume_gradients<d>(corners(x, cell));
    Vec<d> mean = Vec<d>::Zero();
    for (int n : cell) mean += v[n];
    mean /= d + 1;
    for (int k = 0; k <= d; ++k)
      if (unknown_[cell[k]] >= 0) r[unknown_[cell[k]]] += g.col(k).dot(mean);
  }
  for (const auto& f : mesh_->boundary) {
    if (f.wall < 0) continue;
    const Vec<d> area = area_vector_of<d>(f, x) / (d * (d + 1));
    Vec<d> sum = Vec<d>::Zero();
    std::array<Vec<d>, d> w;
    for (int k = 0; k < d; ++k) sum += w[k] = rigid_velocity<d>(s[f.wall], x[f.nodes[k]] - centres[f.wall]);
    for (int k = 0; k < d; ++k)
      if (unknown_[f.nodes[k]] >= 0) r[unknown_[f.nodes[k]]] -= area.dot(sum + w[k]);
  }
}

template <int d>
void PressureEquation<d>::motion_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u,
                                          std::vector<double>& r) const {
  r.assign(size(), 0.0);
  for (const auto& cell : mesh_->cells) {
    const auto g = volume_gradients<d>(corners(x, cell));
    double rate = 0;
    for (int k = 0; k <= d; ++k) rate += g.col(k).dot(u[cell[k]]);
    rate /= d + 1;
    for (int n : cell)
      if (unknown_[n] >= 0) r[unknown_[n]] -= rate;
  }
}

template <int d>
bool PressureEquation<d>::solve(std::vector<double>& r, std::span<Twist<d>> s) {
  if (size() == 0) return true;
  if (!solver_.solve(r)) return false;
  respond(r, s);
  return true;
}

template <int d>
void PressureEquation<d>::respond(std::vector<double>& phi, std::span<Twist<d>> s) const {
  if (responding_.empty()) return;
  constexpr int m = freedoms<d>;
  Eigen::VectorXd load(Y_.cols());
  for (std::size_t k = 0; k < responding_.size(); ++k) load.segment(k * m, m) = impulse(responding_[k], phi);
  const Eigen::VectorXd change = elimination_ * load;
  Eigen::Map<Eigen::VectorXd>(phi.data(), size()) -= Y_ * change;
  for (std::size_t k = 0; k < responding_.size(); ++k) s[responding_[k]] += change.segment(k * m, m);
}

template <int d>
void PressureEquation<d>::accelerate(std::span<const double> phi, std::span<Vec<d>> v) const {
  for (std::size_t c = 0; c < mesh_->cells.size(); ++c) {
    const auto& cell = mesh_->cells[c];
    Vec<d> gradient = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k)
      if (unknown_[cell[k]] >= 0) gradient += gradients_[c].col(k) * phi[unknown_[cell[k]]];
    for (int n : cell) v[n] -= per_nodal_mass_[n] * gradient;
  }
}

template <int d>
Wrench<d> PressureEquation<d>::impulse(std::size_t wall, std::span<const double> phi) const {
  Wrench<d> load = Wrench<d>::Zero();
  for (const Mode& mode : modes_[wall]) load += mode.row * phi[mode.unknown];
  return load;
}

template class PressureEquation<2>;
template class PressureEquation<3>;

}  // namespace splashdown::fluid
