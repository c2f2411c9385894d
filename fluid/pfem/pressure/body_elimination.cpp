// Bodies that the pressure equation solves for: eliminated on the factor, and what they get of a solution.
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense.hpp"
#include "fluid/pfem/linear/conjugate_residual.hpp"
#include "fluid/pfem/pressure/pressure.hpp"

namespace splashdown::fluid {
namespace {

// What is left of a flux, and the impulse that it asks for.
struct Left {
  Eigen::VectorXd residual, impulse;

  double dot(const Left& other) const { return residual.dot(other.impulse); }
  void add(double share, const Left& other) {
    residual += share * other.residual;
    impulse += share * other.impulse;
  }
};

// Factors that make inertias one; 0 for directions in which neither body nor water has any: they stay as they are.
Eigen::VectorXd units_of(const Eigen::VectorXd& inertias) {
  Eigen::VectorXd units(inertias.size());
  for (Eigen::Index i = 0; i < units.size(); ++i) units[i] = inertias[i] > 0 ? 1 / std::sqrt(inertias[i]) : 0.0;
  return units;
}

}  // namespace

template <int d>
bool PressureEquation<d>::add_bodies() {
  Y_.setZero(size(), mode_count());
  for (std::size_t w = 0; w < modes_.size() && mode_count() > 0; ++w) {
    const Eigen::MatrixXd moves = structure_.modal.modes.middleRows(layout_.first(w), layout_.count(w));
    for (const Mode& mode : modes_[w]) Y_.row(mode.unknown) += mode.row.transpose() * moves;
    for (const VertexMode& mode : vertex_modes_[w])
      Y_.row(mode.unknown) += mode.row.transpose() * moves.middleRows<d>(d * static_cast<Eigen::Index>(mode.vertex));
  }
  std::vector<int> wet;  // motions that the water feels
  for (int k = 0; k < mode_count(); ++k)
    if (!Y_.col(k).isZero(0)) wet.push_back(k);
  const Eigen::MatrixXd loads = Y_(Eigen::all, wet);  // B^T Z
  Eigen::MatrixXd answers = loads;
  // The motions obey Newton's law with whatever answers these are; what they leave of the flux the corrections find.
  constexpr double enough = 1e-4;
  const std::span<double> systems(answers.data(), static_cast<std::size_t>(answers.size()));
  if (!wet.empty() && !solver_.solve(systems, static_cast<int>(wet.size()), enough)) return false;
  Y_(Eigen::all, wet) = answers;
  added_mass_.setZero(mode_count(), mode_count());
  added_mass_(wet, wet) = is_many()
                              ? Eigen::MatrixXd(Eigen::SparseMatrix<double>(loads.sparseView()).transpose() * answers)
                              : algebra::transposed_product(loads, answers);
  held_inertia_.setZero(mode_count(), mode_count());
  for (std::size_t w = 0; w < modes_.size() && !held_.empty(); ++w) {
    if (layout_.deforms(w) || !moves_wall<d>(structure_.modal, layout_, w)) continue;
    const Eigen::MatrixXd moves = structure_.modal.modes.middleRows(layout_.first(w), freedoms<d>);
    held_inertia_ += moves.transpose() * held_.inertia(w) * moves;
  }
  if (!held_.empty())
    for (int k = 0; k < mode_count(); ++k)
      held_inertia_.col(k) += of_held({Y_.col(k).data(), static_cast<std::size_t>(size())});
  allow(Eigen::MatrixXd::Identity(mode_count(), mode_count()));
  return true;
}

template <int d>
void PressureEquation<d>::allow(const Eigen::MatrixXd& directions, const Eigen::MatrixXd& workless) {
  elimination_.setZero(mode_count(), mode_count());
  factor_.reset();
  if (directions.cols() == 0) return;
  const Eigen::MatrixXd inertia = structure_.modal.inertia + added_mass_ + held_inertia_;
  if (is_many() && directions.isIdentity(0) && (workless.size() == 0 || workless == directions) &&
      held_inertia_.isZero(0)) {
    constexpr double worst = 1e12;  // of its condition
    units_ = units_of(inertia.diagonal());
    factor_ = algebra::Cholesky::of(units_.asDiagonal() * inertia * units_.asDiagonal(), worst);
    if (factor_) return;
  }
  if (workless.size() > 0 && workless != directions) {
    const auto scaled = [&](const Eigen::MatrixXd& W) -> Eigen::MatrixXd {
      return W * units_of(algebra::congruence(inertia, W).diagonal()).asDiagonal();
    };
    const Eigen::MatrixXd W = scaled(directions), tested = scaled(workless);
    elimination_ = W * algebra::pseudo_inverse(algebra::between(tested, inertia, W)) * tested.transpose();
    return;
  }
  const Eigen::MatrixXd total = algebra::congruence(inertia, directions);
  const Eigen::VectorXd unit = units_of(total.diagonal());
  const Eigen::MatrixXd scaled = unit.asDiagonal() * total * unit.asDiagonal();
  const Eigen::MatrixXd inverse = algebra::pseudo_inverse(scaled);
  const Eigen::MatrixXd lifted = directions * unit.asDiagonal();
  // As symmetric as the answers: Newton's law then holds to roundoff, however closely they were solved for.
  const bool symmetric = solver_.is_direct() && held_inertia_.isZero(0);
  elimination_ = algebra::lifted(lifted, symmetric ? Eigen::MatrixXd(0.5 * (inverse + inverse.transpose())) : inverse);
}

template <int d>
Eigen::VectorXd PressureEquation<d>::response(const Eigen::VectorXd& impulse) const {
  if (!factor_) return elimination_ * impulse;
  return units_.cwiseProduct(factor_->solve(units_.cwiseProduct(impulse)));
}

template <int d>
bool PressureEquation<d>::solve(std::vector<double>& r, double tolerance, std::vector<double> guess) {
  if (size() == 0) return true;
  // Least error in the energy norm: G y = Y^T (r - A guess), and A Y = B^T Z.
  if (!guess.empty() && mode_count() > 0 && !solver_.is_direct()) {
    const Eigen::Map<const Eigen::VectorXd> rhs(r.data(), size());
    const Eigen::VectorXd left = Y_.transpose() * rhs - on_modes(impulses(guess));
    Eigen::Map<Eigen::VectorXd>(guess.data(), size()) += Y_ * algebra::least_squares(added_mass_, left);
  }
  return solver_.solve(r, 1, tolerance, guess);
}

template <int d>
Eigen::VectorXd PressureEquation<d>::respond(std::vector<double>& phi, std::span<WallVelocity<d>> s,
                                             const Eigen::VectorXd& further) const {
  if (mode_count() == 0) return {};
  const Eigen::VectorXd y = response(on_modes(impulses(phi)) + of_held(phi) + further);
  Eigen::Map<Eigen::VectorXd>(phi.data(), size()) -= Y_ * y;
  move(y, s);
  return y;
}

// Z^T R phi
template <int d>
Eigen::VectorXd PressureEquation<d>::of_held(std::span<const double> phi) const {
  std::vector<WallImpulse<d>> loads(held_modes_.size(), Wrench<d>::Zero());
  for (std::size_t w = 0; w < loads.size(); ++w)
    for (const Mode& mode : held_modes_[w]) loads[w].rigid += mode.row * phi[mode.unknown];
  return on_modes(loads);
}

template <int d>
Eigen::VectorXd PressureEquation<d>::on_modes(std::span<const WallImpulse<d>> impulses) const {
  return layout_.on_modes(structure_.modal.modes, impulses);
}

template <int d>
void PressureEquation<d>::move(const Eigen::VectorXd& y, std::span<WallVelocity<d>> s) const {
  if (mode_count() == 0) return;
  const Eigen::VectorXd moved = structure_.modal.modes * y;
  for (std::size_t w = 0; w < s.size(); ++w) s[w] += layout_.of_wall(w, moved);
}

template <int d>
std::vector<WallImpulse<d>> PressureEquation<d>::impulses(std::span<const double> phi) const {
  std::vector<WallImpulse<d>> loads;
  for (std::size_t w = 0; w < modes_.size(); ++w) loads.push_back(impulse(w, phi));
  return loads;
}

template <int d>
WallImpulse<d> PressureEquation<d>::impulse(std::size_t wall, std::span<const double> phi) const {
  WallImpulse<d> load = layout_.zero(wall);
  for (const Mode& mode : modes_[wall]) load.rigid += mode.row * phi[mode.unknown];
  for (const VertexMode& mode : vertex_modes_[wall]) load.vertices.col(mode.vertex) += mode.row * phi[mode.unknown];
  return load;
}

template <int d>
Eigen::MatrixXd PressureEquation<d>::interface_slope(std::span<const std::size_t> walls) {
  const auto pieces = static_cast<Eigen::Index>(laplacian_.pieces().size());
  Eigen::Index count = 0;
  std::vector<Eigen::Index> shift;  // from a wall's coordinates among all to those among these walls
  for (const std::size_t w : walls) shift.push_back(count - layout_.first(w)), count += layout_.count(w);
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(size(), count + pieces);
  for (std::size_t k = 0; k < walls.size(); ++k)
    each_mode(walls[k], [&](int unknown, Eigen::Index first, const auto& row) {
      phi.row(unknown).segment(first + shift[k], row.size()) -= row.transpose();
    });
  std::vector<double> unit(static_cast<std::size_t>(pieces), 0.0), flux;
  for (Eigen::Index k = 0; k < pieces; ++k) {
    flux.assign(size(), 0.0);
    unit[k] = 1;
    laplacian_.add(unit, flux);
    unit[k] = 0;
    phi.col(count + k) = Eigen::Map<const Eigen::VectorXd>(flux.data(), size());
  }
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(count + pieces, count + pieces);
  if (phi.size() == 0) return slope;
  if (!solver_.solve({phi.data(), static_cast<std::size_t>(phi.size())}, static_cast<int>(phi.cols())))
    return slope.array() + std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < walls.size(); ++k)
    each_mode(walls[k], [&](int unknown, Eigen::Index first, const auto& row) {
      slope.middleRows(first + shift[k], row.size()) += row * phi.row(unknown);
    });
  for (Eigen::Index k = 0; k < phi.cols(); ++k) {
    const auto means = laplacian_.means({phi.col(k).data(), static_cast<std::size_t>(size())});
    slope.col(k).tail(pieces) = Eigen::Map<const Eigen::VectorXd>(means.data(), pieces);
  }
  return slope;
}

// The impulse that takes a flux out, with the corrections of a step.
template <int d>
std::optional<Eigen::VectorXd> PressureEquation<d>::corrected(LinearSolver& solver, const Eigen::VectorXd& flux) const {
  const auto asks_for = [&](const Eigen::VectorXd& residual, Left& left) {
    left = {residual, residual};
    return residual.size() == 0 || solver.solve({left.impulse.data(), static_cast<std::size_t>(size())}, 1);
  };
  Left left;
  if (!asks_for(flux, left)) return std::nullopt;
  Eigen::VectorXd impulse = left.impulse;
  if (!asks_for(flux - taken_by(impulse), left)) return std::nullopt;
  ConjugateResidual<Left> iteration(left);
  constexpr double roundoff = 1e-12;  // of sums over neighbours
  const double least = roundoff * roundoff * flux.dot(impulse);
  for (int k = 1; k < corrections<d> && iteration.size() > least; ++k) {
    const Eigen::VectorXd tried = impulse + iteration.left().impulse;
    if (!asks_for(flux - taken_by(tried), left)) return std::nullopt;
    iteration.step(left);
    impulse += iteration.last().impulse;
  }
  return impulse + std::clamp(iteration.share(), 0.0, 1.0) * iteration.left().impulse;
}

// B^T s - D w: the flux of walls that move, and with them the nodes that they hold.
template <int d>
Eigen::VectorXd PressureEquation<d>::flux_of_walls(std::span<const WallVelocity<d>> s) const {
  std::vector<Vec<d>> w(nodes_->size(), Vec<d>::Zero());
  held_.hold(w, s);
  Eigen::VectorXd flux = -flux_of(w);
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    for (const Mode& mode : modes_[k]) flux(mode.unknown) += mode.row.dot(s[k].rigid);
    if (s[k].vertices.size() == 0) continue;
    for (const VertexMode& mode : vertex_modes_[k]) flux(mode.unknown) += mode.row.dot(s[k].vertices.col(mode.vertex));
  }
  return flux;
}

template <int d>
Eigen::MatrixXd PressureEquation<d>::added_mass_of(std::span<const std::size_t> walls) {
  Eigen::Index count = 0;
  for (const std::size_t w : walls) count += layout_.count(w);
  // An interface Laplacian in the factor is one body's answer, not the water's.
  LinearSolver without{most_direct<d>};
  LinearSolver& solver = laplacian_.pieces().empty() ? solver_ : without;
  if (&solver == &without && size() > 0) {
    SymmetricMatrix water;
    assemble(water);
    without.factor(water);
  }
  Eigen::MatrixXd G(count, count);
  std::vector<WallVelocity<d>> s(modes_.size());
  Eigen::Index column = 0;
  for (const std::size_t moving : walls)
    for (Eigen::Index k = 0; k < layout_.count(moving); ++k, ++column) {
      s[moving] = layout_.unit(moving, k);
      const std::optional<Eigen::VectorXd> X = corrected(solver, flux_of_walls(s));
      if (!X) return Eigen::MatrixXd::Constant(count, count, std::numeric_limits<double>::quiet_NaN());
      const std::span<const double> phi(X->data(), static_cast<std::size_t>(size()));
      std::vector<Vec<d>> v(nodes_->size(), Vec<d>::Zero());
      accelerate(phi, v);
      s[moving] = -s[moving];
      const std::vector<WallImpulse<d>> of_held = held_.excess(v, s);  // R X + M_h
      s[moving] = {};
      Eigen::Index row = 0;
      for (const std::size_t w : walls) {
        G.col(column).segment(row, layout_.count(w)) = layout_.stacked(w, impulse(w, phi) + of_held[w]);
        row += layout_.count(w);
      }
    }
  return 0.5 * (G + G.transpose());
}

template class PressureEquation<2>;
template class PressureEquation<3>;

}  // namespace splashdown::fluid
