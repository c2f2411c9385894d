#include "fluid/ale/equations/flow_equations.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "fluid/ale/mesh/cell_rule.hpp"

namespace splashdown::ale {
namespace {

using CellSlopes = Eigen::Matrix<double, 2, 6>;

/// Gradients of shape functions in space and the area that a point stands for.
struct Mapped {
  CellSlopes grad;
  double area;
};
inline Mapped map(const CellPoint& point, const Eigen::Matrix<double, 2, 6>& x) {
  const Mat<2> J = x * point.slopes.transpose();
  const double det = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
  Mat<2> inverse;
  inverse << J(1, 1), -J(1, 0), -J(0, 1), J(0, 0);  // transposed
  return {(inverse / det) * point.slopes, point.weight * det};
}

}  // namespace

FlowEquations::FlowEquations(const FlowMesh& mesh, double density, double viscosity, std::array<bool, side_count> open)
    : mesh_(&mesh), density_(density), viscosity_(viscosity) {
  for (const auto& edge : mesh.boundary) {
    if (edge.side < 0 || !open[static_cast<std::size_t>(edge.side)]) continue;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (int k = 0; k < 3; ++k)
        if (mesh.cells[c][static_cast<std::size_t>(k)] == edge.nodes[0] &&
            mesh.cells[c][static_cast<std::size_t>((k + 1) % 3)] == edge.nodes[1])
          open_.push_back({c, k, (k + 1) % 3});
  }
  const auto middle = cell_point(Barycentric<2>::Constant(1. / 3), 0.5);
  for (const auto& cell : mesh.cells) first_volume_.push_back(map(middle, of(mesh.nodes, cell)).area);
  make_pattern();
}

std::array<Eigen::Index, FlowEquations::dofs> FlowEquations::numbers(const Cell& cell) const {
  std::array<Eigen::Index, dofs> all{};
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 2; ++i)
      all[static_cast<std::size_t>(2 * a + i)] = velocity(cell[static_cast<std::size_t>(a)], i);
  for (int k = 0; k < 3; ++k) all[static_cast<std::size_t>(12 + k)] = pressure(cell[static_cast<std::size_t>(k)]);
  return all;
}

FlowEquations::CellNodes FlowEquations::of(const Nodes& field, const Cell& cell) const {
  CellNodes values;
  for (int a = 0; a < 6; ++a) values.col(a) = field.col(cell[static_cast<std::size_t>(a)]);
  return values;
}

FlowEquations::CellNodes FlowEquations::velocities(const Unknowns& at, const Cell& cell) const {
  CellNodes values;
  for (int a = 0; a < 6; ++a) values.col(a) = at.segment<2>(velocity(cell[static_cast<std::size_t>(a)], 0));
  return values;
}

void FlowEquations::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  const auto couples = [](int i, int j) { return i < 12 || j < 12; };
  for (const auto& cell : mesh_->cells) {
    const auto number = numbers(cell);
    for (int i = 0; i < dofs; ++i)
      for (int j = 0; j < dofs; ++j)
        if (couples(i, j))
          entries.emplace_back(number[static_cast<std::size_t>(i)], number[static_cast<std::size_t>(j)], 0.0);
  }
  pattern_.resize(size(), size());
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();
  for (const auto& cell : mesh_->cells) {
    const auto number = numbers(cell);
    auto& places = places_.emplace_back();
    for (int j = 0; j < dofs; ++j) {
      const auto column = number[static_cast<std::size_t>(j)];
      const int *first = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column],
                *last = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + 1];
      for (int i = 0; i < dofs; ++i)
        places[static_cast<std::size_t>(dofs * j + i)] =
            couples(i, j) ? static_cast<int>(std::lower_bound(first, last, number[static_cast<std::size_t>(i)]) -
                                             pattern_.innerIndexPtr())
                          : -1;
    }
  }
}

void FlowEquations::add_cell(const StepFields& fields, const Unknowns& at, std::size_t c, CellVector& R,
                             CellMatrix* K) const {
  const Cell& cell = mesh_->cells[c];
  const CellNodes x = of(fields.x, cell), x_after = of(fields.x_after, cell), before = of(fields.before, cell),
                  after = velocities(at, cell), w = of(fields.mesh_velocity, cell);
  const double theta = fields.theta, rate = fields.rate, rho = density_, mu = viscosity_;
  const CellNodes mean = theta * after + (1 - theta) * before, change = rate * (after - before);
  const bool moves = x != x_after;
  Eigen::Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = at[pressure(cell[static_cast<std::size_t>(k)])];
  for (const auto& point : cell_rule()) {
    const auto [g, area] = map(point, x);
    const Vec<2> u = mean * point.N, across = u - w * point.N;
    const Mat<2> gradient = mean * g.transpose();  // (a, b): du_a/dx_b
    Vec<2> inertia = change * point.N + gradient * across;
    if (fields.force) inertia -= fields.force(x * point.N);
    const Mat<2> stress = mu * (gradient + gradient.transpose()) - p.dot(point.L) * Mat<2>::Identity();
    const Eigen::Matrix<double, 2, 6> momentum = area * (rho * inertia * point.N.transpose() + stress * g);
    for (int a = 0; a < 6; ++a) R.segment<2>(2 * a) += momentum.col(a);
    const auto [g_after, area_after] = moves ? map(point, x_after) : Mapped{g, area};
    const double divergence = after.cwiseProduct(g_after).sum();
    R.tail<3>() -= area_after * divergence * point.L;
    if (!K) continue;
    const Eigen::Matrix<double, 6, 1> along = g.transpose() * across;
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 6; ++i) {
        const double both =
            area * (rho * point.N[i] * (rate * point.N[j] + theta * along[j]) + theta * mu * g.col(i).dot(g.col(j)));
        const double turned = area * theta * rho * point.N[i] * point.N[j];
        Mat<2> block = turned * gradient + area * theta * mu * (g.col(j) * g.col(i).transpose());
        block(0, 0) += both;
        block(1, 1) += both;
        K->block<2, 2>(2 * i, 2 * j) += block;
      }
      K->block<3, 2>(12, 2 * j) -= area_after * point.L * g_after.col(j).transpose();
      K->block<2, 3>(2 * j, 12) -= area * g.col(j) * point.L.transpose();
    }
  }
}

/// -int mu (grad u)^T n . phi: what the symmetric stress has more than mu du/dn. Where the flow comes back, -int 1/2 rho (u . n) u . phi
/// besides: it brings no energy along.
void FlowEquations::add_open(const StepFields& fields, const Unknowns& at, const OpenEdge& edge, CellVector& R,
                             CellMatrix* K) const {
  const Cell& cell = mesh_->cells[edge.cell];
  const CellNodes x = of(fields.x, cell),
                  mean = fields.theta * velocities(at, cell) + (1 - fields.theta) * of(fields.before, cell);
  for (const auto& on : rule<1>()) {
    Barycentric<2> place = Barycentric<2>::Zero();
    place[edge.from] = on.at[0];
    place[edge.to] = on.at[1];
    const auto point = cell_point(place, 1);
    const auto g = map(point, x).grad;
    Vec<2> reference = Vec<2>::Zero();  // along the edge, in coordinates of corners 1 and 2
    if (edge.to > 0) reference[edge.to - 1] += 1;
    if (edge.from > 0) reference[edge.from - 1] -= 1;
    const Vec<2> along = x * (point.slopes.transpose() * reference);
    const Vec<2> normal = on.weight * Vec<2>(along.y(), -along.x());  // times the length
    Vec<2> traction = viscosity_ * ((mean * g.transpose()).transpose() * normal);
    const Vec<2> u = mean * point.N;
    const bool comes_back = u.dot(normal) < 0;
    if (comes_back) traction += 0.5 * density_ * u.dot(normal) * u;
    for (int i = 0; i < 6; ++i) R.segment<2>(2 * i) -= point.N[i] * traction;
    if (!K) continue;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        K->block<2, 2>(2 * i, 2 * j) -= fields.theta * viscosity_ * point.N[i] * (g.col(j) * normal.transpose());
    if (!comes_back) continue;
    const Mat<2> slope = 0.5 * density_ * (u.dot(normal) * Mat<2>::Identity() + u * normal.transpose());
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) K->block<2, 2>(2 * i, 2 * j) -= fields.theta * point.N[i] * point.N[j] * slope;
  }
}

void FlowEquations::residual(const StepFields& fields, const Unknowns& at, Eigen::VectorXd& out) const {
  out.setZero(size());
  const auto add = [&](std::size_t c, const CellVector& R) {
    const auto number = numbers(mesh_->cells[c]);
    for (int i = 0; i < dofs; ++i) out[number[static_cast<std::size_t>(i)]] += R[i];
  };
  for (std::size_t c = 0; c < mesh_->cells.size(); ++c) {
    CellVector R = CellVector::Zero();
    add_cell(fields, at, c, R, nullptr);
    add(c, R);
  }
  for (const auto& edge : open_) {
    CellVector R = CellVector::Zero();
    add_open(fields, at, edge, R, nullptr);
    add(edge.cell, R);
  }
}

void FlowEquations::linearise(const StepFields& fields, const Unknowns& at, Eigen::SparseMatrix<double>& slope) const {
  if (slope.nonZeros() != pattern_.nonZeros()) slope = pattern_;
  Eigen::Map<Eigen::VectorXd>(slope.valuePtr(), slope.nonZeros()).setZero();
  const auto add = [&](std::size_t c, const CellMatrix& K) {
    const auto& places = places_[c];
    for (int k = 0; k < dofs * dofs; ++k)
      if (places[static_cast<std::size_t>(k)] >= 0)
        slope.valuePtr()[places[static_cast<std::size_t>(k)]] += K.data()[k];
  };
  for (std::size_t c = 0; c < mesh_->cells.size(); ++c) {
    CellVector R = CellVector::Zero();
    CellMatrix K = CellMatrix::Zero();
    add_cell(fields, at, c, R, &K);
    add(c, K);
  }
  for (const auto& edge : open_) {
    CellVector R = CellVector::Zero();
    CellMatrix K = CellMatrix::Zero();
    add_open(fields, at, edge, R, &K);
    add(edge.cell, K);
  }
}

double FlowEquations::open_power(const StepFields& fields, const Unknowns& at) const {
  double power = 0;
  for (const auto& edge : open_) {
    const Cell& cell = mesh_->cells[edge.cell];
    CellVector R = CellVector::Zero();
    add_open(fields, at, edge, R, nullptr);
    const CellNodes mean = fields.theta * velocities(at, cell) + (1 - fields.theta) * of(fields.before, cell);
    power -= R.head<12>().dot(mean.reshaped());
  }
  return power;
}

double FlowEquations::least_stretch(const Nodes& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < mesh_->cells.size(); ++c) {
    const CellNodes nodes = of(x, mesh_->cells[c]);
    for (int i = 0; i < 3; ++i)
      least = std::min(least, map(cell_point(Barycentric<2>::Unit(i), 0.5), nodes).area / first_volume_[c]);
    for (const auto& point : cell_rule())
      least = std::min(least, 0.5 * map(point, nodes).area / point.weight / first_volume_[c]);
  }
  return least;
}

double FlowEquations::kinetic_energy(const Nodes& x, const Nodes& velocity) const {
  double sum = 0;
  for (const auto& cell : mesh_->cells) {
    const CellNodes nodes = of(x, cell), v = of(velocity, cell);
    for (const auto& point : cell_rule()) sum += map(point, nodes).area * (v * point.N).squaredNorm();
  }
  return 0.5 * density_ * sum;
}

Vec<2> FlowEquations::momentum(const Nodes& x, const Nodes& velocity) const {
  Vec<2> sum = Vec<2>::Zero();
  for (const auto& cell : mesh_->cells) {
    const CellNodes nodes = of(x, cell), v = of(velocity, cell);
    for (const auto& point : cell_rule()) sum += map(point, nodes).area * (v * point.N);
  }
  return density_ * sum;
}

double FlowEquations::divergence(const Nodes& x, const Nodes& velocity) const {
  double sum = 0;
  for (const auto& cell : mesh_->cells) {
    const CellNodes nodes = of(x, cell), v = of(velocity, cell);
    for (const auto& point : cell_rule()) {
      const auto [g, area] = map(point, nodes);
      const double divergence = v.cwiseProduct(g).sum();
      sum += area * divergence * divergence;
    }
  }
  return sum;
}

}  // namespace splashdown::ale
