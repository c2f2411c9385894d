#include "fluid/pressure/pressure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dense.hpp"
#include "fluid/parallel.hpp"

namespace splashdown::fluid {
template <int d>
bool PressureEquation<d>::build(const Nodes<d>& nodes, const Mesh<d>& mesh, double density,
                                std::span<const Vec<d>> centres, const WallResponse<d>& response,
                                std::vector<HeldNode<d>> held) {
  nodes_ = &nodes;
  mesh_ = &mesh;
  response_ = response;
  around_.build(mesh.cells, nodes.size());
  measure(density);
  choose_unknowns();
  wall_modes(centres);
  hold_mass(std::move(held), density);
  laplacian_.build(nodes, mesh, unknown_, response.interface_operators);
  assemble(matrix_);
  laplacian_.add_to(matrix_);
  return (size() == 0 || factored()) && add_bodies();
}

template <int d>
void PressureEquation<d>::hold_mass(std::vector<HeldNode<d>> held, double density) {
  held_.build(std::move(held), modes_.size(), density, lumped_);
  held_modes_.assign(modes_.size(), {});
  if (held_.empty()) return;
  std::vector<double> share(per_mass_.size());
  for (std::size_t c = 0; c < share.size(); ++c) share[c] = 1 / ((d + 2) * per_mass_[c]);
  const AccelerationWeights<d> weights{*mesh_, nodes_->x, around_, gradients_, share, per_nodal_mass_};
  for (std::size_t w = 0; w < modes_.size(); ++w) {
    if (!response_.moves(w)) continue;
    for (const auto& column : held_.load(w, weights))
      if (unknown_[column.node] >= 0) held_modes_[w].push_back({unknown_[column.node], column.wrench});
  }
}

// Z^T R phi
template <int d>
Eigen::VectorXd PressureEquation<d>::of_held(std::span<const double> phi) const {
  std::vector<Wrench<d>> loads(held_modes_.size(), Wrench<d>::Zero());
  for (std::size_t w = 0; w < loads.size(); ++w)
    for (const Mode& mode : held_modes_[w]) loads[w] += mode.row * phi[mode.unknown];
  return on_motions(loads);
}

template <int d>
bool PressureEquation<d>::add_bodies() {
  constexpr int m = freedoms<d>;
  Y_.setZero(size(), motions());
  for (std::size_t w = 0; w < modes_.size(); ++w) {
    if (motions() == 0) break;
    const Eigen::MatrixXd moves = response_.modes.middleRows(static_cast<Eigen::Index>(w) * m, m);
    for (const Mode& mode : modes_[w]) Y_.row(mode.unknown) += mode.row.transpose() * moves;
  }
  std::vector<int> wet;  // motions that the water feels
  for (int k = 0; k < motions(); ++k)
    if (!Y_.col(k).isZero(0)) wet.push_back(k);
  const Eigen::MatrixXd loads = Y_(Eigen::all, wet);  // B^T Z
  Eigen::MatrixXd answers = loads;
  // The motions obey Newton's law with whatever answers these are; what they leave of the flux the corrections find.
  constexpr double enough = 1e-4;
  const std::span<double> systems(answers.data(), static_cast<std::size_t>(answers.size()));
  if (!wet.empty() && !solver_.solve(systems, static_cast<int>(wet.size()), enough)) return false;
  Y_(Eigen::all, wet) = answers;
  added_mass_.setZero(motions(), motions());
  added_mass_(wet, wet) = algebra::transposed_product(loads, answers);
  held_inertia_.setZero(motions(), motions());
  for (std::size_t w = 0; w < modes_.size() && !held_.empty(); ++w) {
    if (!response_.moves(w)) continue;
    const Eigen::MatrixXd moves = response_.modes.middleRows(static_cast<Eigen::Index>(w) * m, m);
    held_inertia_ += moves.transpose() * held_.inertia(w) * moves;
  }
  if (!held_.empty())
    for (int k = 0; k < motions(); ++k)
      held_inertia_.col(k) += of_held({Y_.col(k).data(), static_cast<std::size_t>(size())});
  allow(Eigen::MatrixXd::Identity(motions(), motions()));
  return true;
}

// Directions in which neither body nor water has inertia stay as they are.
template <int d>
void PressureEquation<d>::allow(const Eigen::MatrixXd& directions) {
  elimination_.setZero(motions(), motions());
  if (directions.cols() == 0) return;
  const Eigen::MatrixXd total = algebra::congruence(response_.inertia + added_mass_ + held_inertia_, directions);
  const Eigen::VectorXd diagonal = total.diagonal();
  Eigen::VectorXd unit(diagonal.size());
  for (Eigen::Index i = 0; i < unit.size(); ++i) unit[i] = diagonal[i] > 0 ? 1 / std::sqrt(diagonal[i]) : 0.0;
  const Eigen::MatrixXd scaled = unit.asDiagonal() * total * unit.asDiagonal();
  const Eigen::MatrixXd inverse = algebra::pseudo_inverse(scaled);
  const Eigen::MatrixXd lifted = directions * unit.asDiagonal();
  // As symmetric as the answers: Newton's law then holds to roundoff, however closely they were solved for.
  const bool symmetric = solver_.is_direct() && held_inertia_.isZero(0);
  elimination_ = algebra::lifted(lifted, symmetric ? Eigen::MatrixXd(0.5 * (inverse + inverse.transpose())) : inverse);
}

template <int d>
void PressureEquation<d>::measure(double density) {
  const std::size_t count = nodes_->size();
  lumped_.assign(count, 0.0);
  gradients_.resize(mesh_->cells.size());
  per_mass_.resize(mesh_->cells.size());
  rate_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto at = corners(nodes_->x, mesh_->cells[c]);
    gradients_[c] = volume_gradients<d>(at);
    const double volume = (at(d) - at(0)).dot(gradients_[c].col(d));
    per_mass_[c] = 1 / (density * volume);
    rate_[c] = volume / (d + 1);
  });
  in_parallel(count, [&](std::size_t i) {
    for (const auto [c, k] : around_.around(i)) lumped_[i] += rate_[c];
  });
  // Nodes of slivers weigh next to nothing and would be shot away; they resist like a small part of a neighbour.
  constexpr double lightest = 0.02;
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    rate_[c] = 0;
    for (int n : mesh_->cells[c]) rate_[c] = std::max(rate_[c], lumped_[n]);
  });
  per_nodal_mass_.resize(count);
  in_parallel(count, [&](std::size_t i) {
    double heaviest = 0;
    for (const auto [c, k] : around_.around(i)) heaviest = std::max(heaviest, rate_[c]);
    per_nodal_mass_[i] = 1 / (density * (d + 1) * std::max(lumped_[i], lightest * heaviest));
  });
  free_area_.assign(count, Vec<d>::Zero());
  free_measure_.assign(count, 0.0);
  free_spread_.assign(count, 0.0);
  std::vector<int> facets(count, 0);
  for (const auto& f : mesh_->boundary) {
    if (f.wall >= 0) continue;
    const Vec<d> share = area_vector_of<d>(f, nodes_->x) / d;
    for (int n : f.nodes) {
      free_area_[n] += share;
      free_measure_[n] += share.norm();
      free_spread_[n] += share.squaredNorm();
      ++facets[n];
    }
  }
  for (std::size_t i = 0; i < count; ++i) free_spread_[i] *= facets[i];
}

// Contact lines keep phi = 0 where the water is a thin wedge there or separates. Steep ones keep their volume like the rest
// of the surface: held to p = 0 they push still water about.
template <int d>
bool PressureEquation<d>::at_contact_line(int node) const {
  // Volume over surface^(d/(d-1)): 0.7 to 1.3 (plane), 0.6 (space) at a right angle, 0.3, 0.2 at 30 degrees.
  constexpr double steep = 0.3;
  const WallTie& tie = nodes_->tie[node];
  if (tie.wall < 0) return false;
  return nodes_->separates[node] || lumped_[node] < steep * std::pow(free_measure_[node], d / (d - 1.0));
}

template <int d>
void PressureEquation<d>::choose_unknowns() {
  // All surface nodes but those on a spike of the bulk: a volume this small for its surface, 0.43 on a flat one in
  // 2D, would be thrown by what little is left of the volume's error. Sheets are thin by nature, and their volume is kept
  // like any other's: left to fly, they gain volume, hence energy, while they stretch.
  auto on_sheet = [&](std::size_t i) {
    const auto around = around_.around(i);
    return std::any_of(around.begin(), around.end(), [&](const auto& at) {
      const auto& cell = mesh_->cells[at.cell];
      return std::all_of(cell.begin(), cell.end(), [&](int n) { return nodes_->surface[n]; });
    });
  };
  unknown_.assign(nodes_->size(), -1);
  node_.clear();
  for (std::size_t i = 0; i < nodes_->size(); ++i) {
    auto on_spike = [&] {
      return lumped_[i] < lightest_on_surface * std::pow(free_measure_[i], d / (d - 1.0)) && !on_sheet(i);
    };
    const bool held = nodes_->surface[i] && (at_contact_line(static_cast<int>(i)) || on_spike());
    if (held || nodes_->spray[i]) {
      free_area_[i].setZero();
      continue;
    }
    unknown_[i] = static_cast<int>(node_.size());
    node_.push_back(static_cast<int>(i));
  }
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
void PressureEquation<d>::assemble(SymmetricMatrix& matrix) {
  assembly_.build(mesh_->cells, around_, unknown_, node_, [&](int c, int a, int b) {
    const int i = mesh_->cells[c][a], j = mesh_->cells[c][b];
    const auto of_a = gradients_[c].col(a), of_b = gradients_[c].col(b);
    double entry = of_a.dot(of_b) * per_mass_[c];
    if (nodes_->surface[i]) entry -= free_area_[i].dot(of_b) * per_nodal_mass_[i];
    if (nodes_->surface[j]) entry -= free_area_[j].dot(of_a) * per_nodal_mass_[j];
    return entry;
  });
  matrix.column_start.swap(assembly_.column_start);
  matrix.row.swap(assembly_.row);
  matrix.value.swap(assembly_.value);
  for (int k = 0; k < size(); ++k)
    matrix.value[matrix.column_start[k]] += 2 * free_spread_[node_[k]] * (d + 1) * per_nodal_mass_[node_[k]];
}

template <int d>
void PressureEquation<d>::flux_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> v,
                                        std::span<const Twist<d>> s, std::span<const Vec<d>> centres,
                                        std::vector<double>& r) const {
  of_corner_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto& cell = mesh_->cells[c];
    const auto g = volume_gradients<d>(corners(x, cell));
    Vec<d> mean = Vec<d>::Zero();
    for (int n : cell) mean += v[n];
    mean /= d + 1;
    for (int k = 0; k <= d; ++k) of_corner_[c][k] = g.col(k).dot(mean);
  });
  r.resize(size());
  in_parallel(node_.size(), [&](std::size_t i) {
    double sum = 0;
    for (const auto [c, k] : around_.around(node_[i])) sum += of_corner_[c][k];
    r[i] = sum;
  });
  for (const auto& f : mesh_->boundary)
    add_flux(
        f, x,
        [&](int n) -> Vec<d> {
          return f.wall < 0 ? Vec<d>(-v[n]) : Vec<d>(-rigid_velocity<d>(s[f.wall], x[n] - centres[f.wall]));
        },
        r);
}

// r(q) += int_f q w.n dA, w linear between the facet's nodes.
template <int d>
template <class Velocity>
void PressureEquation<d>::add_flux(const Facet<d>& f, std::span<const Vec<d>> x, Velocity velocity,
                                   std::vector<double>& r) const {
  const Vec<d> area = area_vector_of<d>(f, x) / (d * (d + 1));
  Vec<d> sum = Vec<d>::Zero();
  std::array<Vec<d>, d> w;
  for (int k = 0; k < d; ++k) sum += w[k] = velocity(f.nodes[k]);
  for (int k = 0; k < d; ++k)
    if (unknown_[f.nodes[k]] >= 0) r[unknown_[f.nodes[k]]] += area.dot(sum + w[k]);
}

template <int d>
void PressureEquation<d>::motion_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u,
                                          std::vector<double>& r) const {
  rate_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    const auto& cell = mesh_->cells[c];
    const auto g = volume_gradients<d>(corners(x, cell));
    double rate = 0;
    for (int k = 0; k <= d; ++k) rate += g.col(k).dot(u[cell[k]]);
    rate_[c] = rate / (d + 1);
  });
  r.resize(size());
  in_parallel(node_.size(), [&](std::size_t i) {
    double sum = 0;
    for (const auto [c, k] : around_.around(node_[i])) sum -= rate_[c];
    r[i] = sum;
  });
}

template <int d>
void PressureEquation<d>::slide_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u,
                                         std::span<const Twist<d>> s, std::span<const Vec<d>> centres,
                                         std::span<const int> slides, std::vector<double>& r) const {
  for (int k : slides) {
    const auto& f = mesh_->boundary[k];
    add_flux(
        f, x, [&](int n) -> Vec<d> { return u[n] - rigid_velocity<d>(s[f.wall], x[n] - centres[f.wall]); }, r);
  }
}

template <int d>
bool PressureEquation<d>::solve(std::vector<double>& r, double tolerance, std::vector<double> guess) {
  if (size() == 0) return true;
  // Least error in the energy norm: G y = Y^T (r - A guess), and A Y = B^T Z.
  if (!guess.empty() && motions() > 0 && !solver_.is_direct()) {
    const Eigen::Map<const Eigen::VectorXd> rhs(r.data(), size());
    const Eigen::VectorXd left = Y_.transpose() * rhs - on_motions(impulses(guess));
    Eigen::Map<Eigen::VectorXd>(guess.data(), size()) += Y_ * algebra::least_squares(added_mass_, left);
  }
  return solver_.solve(r, 1, tolerance, guess);
}

template <int d>
Eigen::VectorXd PressureEquation<d>::on_motions(std::span<const Wrench<d>> impulses) const {
  constexpr int m = freedoms<d>;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(motions());
  if (motions() == 0) return sum;
  for (std::size_t w = 0; w < impulses.size(); ++w)
    sum += response_.modes.middleRows(static_cast<Eigen::Index>(w) * m, m).transpose() * impulses[w];
  return sum;
}

template <int d>
void PressureEquation<d>::move(const Eigen::VectorXd& y, std::span<Twist<d>> s) const {
  constexpr int m = freedoms<d>;
  if (motions() == 0) return;
  const Eigen::VectorXd twists = response_.modes * y;
  for (std::size_t w = 0; w < s.size(); ++w) s[w] += twists.segment<m>(static_cast<Eigen::Index>(w) * m);
}

template <int d>
Eigen::VectorXd PressureEquation<d>::respond(std::vector<double>& phi, std::span<Twist<d>> s,
                                             const Eigen::VectorXd& further) const {
  if (motions() == 0) return {};
  const Eigen::VectorXd y = response(on_motions(impulses(phi)) + of_held(phi) + further);
  Eigen::Map<Eigen::VectorXd>(phi.data(), size()) -= Y_ * y;
  move(y, s);
  return y;
}

template <int d>
Eigen::MatrixXd PressureEquation<d>::interface_slope(std::span<const std::size_t> walls) {
  constexpr int m = freedoms<d>;
  const auto pieces = static_cast<Eigen::Index>(laplacian_.pieces().size());
  const auto count = static_cast<Eigen::Index>(walls.size()) * m;
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(size(), count + pieces);
  for (std::size_t k = 0; k < walls.size(); ++k)
    for (const Mode& mode : modes_[walls[k]]) phi.row(mode.unknown).segment(k * m, m) -= mode.row.transpose();
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
    for (const Mode& mode : modes_[walls[k]]) slope.middleRows(k * m, m) += mode.row * phi.row(mode.unknown);
  for (Eigen::Index k = 0; k < phi.cols(); ++k) {
    const auto means = laplacian_.means({phi.col(k).data(), static_cast<std::size_t>(size())});
    slope.col(k).tail(pieces) = Eigen::Map<const Eigen::VectorXd>(means.data(), pieces);
  }
  return slope;
}

// K phi: the volume that the motion by an impulse takes out, in flux form.
template <int d>
Eigen::VectorXd PressureEquation<d>::taken_by(const Eigen::VectorXd& phi) const {
  std::vector<Vec<d>> v(nodes_->size(), Vec<d>::Zero());
  accelerate({phi.data(), static_cast<std::size_t>(phi.size())}, v);
  const std::vector<Twist<d>> still(modes_.size(), Twist<d>::Zero());
  const std::vector<Vec<d>> origin(modes_.size(), Vec<d>::Zero());
  std::vector<double> r;
  flux_residual(nodes_->x, v, still, origin, r);
  return -Eigen::Map<const Eigen::VectorXd>(r.data(), size());
}

template <int d>
Eigen::MatrixXd PressureEquation<d>::added_mass_of(std::span<const std::size_t> walls) {
  constexpr int m = freedoms<d>;
  const auto count = static_cast<Eigen::Index>(walls.size()) * m;
  Eigen::MatrixXd flux = Eigen::MatrixXd::Zero(size(), count);
  for (std::size_t k = 0; k < walls.size(); ++k)
    for (const Mode& mode : modes_[walls[k]])
      flux.row(mode.unknown).segment(static_cast<Eigen::Index>(k) * m, m) += mode.row.transpose();
  // An interface Laplacian in the factor is one body's answer, not the water's.
  LinearSolver without{most_direct<d>};
  LinearSolver& solver = laplacian_.pieces().empty() ? solver_ : without;
  if (&solver == &without && flux.size() > 0) {
    SymmetricMatrix water;
    assemble(water);
    without.factor(water);
  }
  Eigen::MatrixXd impulses = Eigen::MatrixXd::Zero(size(), count);
  for (int pass = 0; pass <= corrections<d> && flux.size() > 0; ++pass) {
    Eigen::MatrixXd left = flux;
    for (Eigen::Index k = 0; k < count && pass > 0; ++k) left.col(k) -= taken_by(impulses.col(k));
    if (!solver.solve({left.data(), static_cast<std::size_t>(left.size())}, static_cast<int>(count)))
      return Eigen::MatrixXd::Constant(count, count, std::numeric_limits<double>::quiet_NaN());
    impulses += left;
  }
  const Eigen::MatrixXd G = algebra::transposed_product(flux, impulses);
  return 0.5 * (G + G.transpose());
}

template <int d>
void PressureEquation<d>::accelerate(std::span<const double> phi, std::span<Vec<d>> v) const {
  auto impulse_at = [&](int n) { return unknown_[n] < 0 ? 0.0 : phi[unknown_[n]]; };
  of_cell_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    Vec<d> sum = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k) sum += gradients_[c].col(k) * impulse_at(mesh_->cells[c][k]);
    of_cell_[c] = sum;
  });
  change_.resize(v.size());
  in_parallel(v.size(), [&](std::size_t i) {
    const double per_mass = per_nodal_mass_[i];
    Vec<d> sum = Vec<d>::Zero();
    for (const auto [c, k] : around_.around(i)) sum -= per_mass * of_cell_[c];
    change_[i] = sum;
  });
  for (const auto& f : mesh_->boundary) {
    if (f.wall >= 0) continue;
    const Vec<d> share = area_vector_of<d>(f, nodes_->x) / d;
    double sum = 0;
    for (int n : f.nodes) sum += impulse_at(n);
    for (int n : f.nodes) change_[n] += per_nodal_mass_[n] * (sum + impulse_at(n)) * share;
  }
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    Vec<d> sum = Vec<d>::Zero();
    for (int n : mesh_->cells[c]) sum += change_[n];
    of_cell_[c] = sum;
    rate_[c] = 1 / ((d + 2) * per_mass_[c]);
  });
  in_parallel(v.size(), [&](std::size_t i) {
    const double per_mass = per_nodal_mass_[i];
    const Vec<d> change = change_[i];
    Vec<d> weighted = Vec<d>::Zero();  // M_L^-1 M_C change
    for (const auto [c, k] : around_.around(i)) weighted += rate_[c] * per_mass * (of_cell_[c] + change);
    v[i] += 2 * change - weighted;
  });
}

// 1 / (1 + z) on the spectrum of z = 1 - M_L^-1 M_C, [0, (d + 1) / (d + 2)]: exact at its ends and in value and slope at
// z = 0, within 4 % between.
template <int d>
double PressureEquation<d>::kinetic_energy(std::span<const Vec<d>> v) const {
  constexpr double stiffest = (d + 1.0) / (d + 2.0), curvature = 1 / (1 + stiffest);
  of_cell_.resize(mesh_->cells.size());
  in_parallel(mesh_->cells.size(), [&](std::size_t c) {
    Vec<d> sum = Vec<d>::Zero();
    for (int n : mesh_->cells[c]) sum += v[n];
    of_cell_[c] = sum;
    rate_[c] = 1 / ((d + 1) * (d + 2) * per_mass_[c]);
  });
  double twice = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    double mass = 0;
    Vec<d> consistent = Vec<d>::Zero();
    for (const auto [c, k] : around_.around(i)) {
      consistent += rate_[c] * (of_cell_[c] + v[i]);
      mass += (d + 2) * rate_[c];
    }
    if (mass <= 0) continue;
    const Vec<d> z = v[i] - consistent / mass;
    twice += mass * (v[i].squaredNorm() - v[i].dot(z) + curvature * z.squaredNorm());
  }
  return 0.5 * twice;
}

template <int d>
std::vector<Wrench<d>> PressureEquation<d>::impulses(std::span<const double> phi) const {
  std::vector<Wrench<d>> loads;
  for (std::size_t w = 0; w < modes_.size(); ++w) loads.push_back(impulse(w, phi));
  return loads;
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
