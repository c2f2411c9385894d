// The motion over a step: repair, effects, pressure, corrections, and what they load walls with.
#include <cmath>
#include <stdexcept>

#include "fluid/fluid_state.hpp"
#include "fluid/parallel.hpp"

namespace splashdown::fluid {
namespace {

// Measured on a standing wave: with fewer its amplitude drifts by more than 0.5 % a period.
constexpr int corrections = 3;
constexpr int repairs = 2;
// Tolerances of iterative solves. Each pass of the repair and of the corrections leaves a tenth of the residual anyhow;
// the pressure solve takes out what the repair leaves of the flux, the corrections what the pressure solve leaves.
constexpr double closely = 1e-4, roughly = 1e-2;

}  // namespace

template <int d>
Status Fluid<d>::State::solve(std::span<const Twist<d>> given, std::span<const double> previous,
                              const MotionDrive& drive) {
  if (previous.size() != equation.laplacian().pieces().size())
    throw std::invalid_argument("fluid: previous interface impulses must be given where there is a Laplacian");
  trial.v = work.nodes.v;
  trial.s_before = work.velocity;
  trial.x_mid.resize(trial.v.size());
  trial.on_walls.assign(walls.size(), Wrench<d>::Zero());
  trial.dragged = trial.on_walls;
  trial.known.setZero(equation.motions());
  trial.answer = trial.known;
  if (drive.directions.size() > 0 || drive.impulse.size() > 0) equation.allow(drive.directions);
  if (auto status = repair(); !status.ok()) return status;
  if (auto status = predict(); !status.ok()) return status;
  {
    const auto scope = timer.scope(pressure);
    if (auto status = press(given, previous); !status.ok()) return status;
    push(drive.impulse);
    if (auto status = correct(previous); !status.ok()) return status;
    weigh();
  }
  return finite() ? Status{} : Status{"the solution is not finite"};
}

// The Laplacian acts on the change since the previous pass, so that it vanishes when passes agree. The repair
// keeps it: it stands for the body's answer, and what it leaves of the flux the pressure finds.
template <int d>
void Fluid<d>::State::lag(std::vector<double>& residual, std::span<const double> previous,
                          std::span<const double> present) const {
  if (previous.empty()) return;
  std::vector<double> change = equation.laplacian().means(present);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] = previous[k] - change[k];
  equation.laplacian().add(change, residual);
}

// The carried velocity, seen at t_{n-1/2} on the new mesh, creates no volume.
template <int d>
Status Fluid<d>::State::repair() {
  const auto scope = timer.scope(pressure);
  auto& v = trial.v;
  auto& r = trial.r;
  auto& s_before = trial.s_before;
  trial.repaired.assign(equation.size(), 0.0);
  energy_before = kinetic_energy(v);
  for (int k = 0; k < repairs; ++k) {
    middle(v, -0.5 * work.dt);
    equation.flux_residual(trial.x_mid, v, s_before, centres(moved_poses(s_before, -0.5 * work.dt)), r);
    if (!solve_with_bodies(r, s_before, roughly)) return {"the pressure solve failed"};
    equation.accelerate(r, v);
    for (int i = 0; i < equation.size(); ++i) trial.repaired[i] += r[i];
  }
  energy_repaired = kinetic_energy(v);
  return {};
}

template <int d>
Status Fluid<d>::State::predict() {
  std::vector<Vec<d>> carried;
  if (!terms.empty()) {
    const auto scope = timer.scope(momentum);
    carried = trial.v;
  }
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto scope = timer.scope(effects + t);
    if (auto status = terms[t]->predict(view(), {carried, trial.s_before}, {trial.v, trial.on_walls}); !status.ok())
      return status;
  }
  return {};
}

// The motion to t_{n+1} creates no volume either. s includes the repair's push on bodies.
template <int d>
Status Fluid<d>::State::press(std::span<const Twist<d>> given, std::span<const double> previous) {
  s_after.assign(given.begin(), given.end());
  for (std::size_t w = 0; w < walls.size(); ++w) s_after[w] += trial.s_before[w] - work.velocity[w];
  middle(trial.v, 0.5 * dt);
  equation.flux_residual(trial.x_mid, trial.v, s_after, centres(moved_poses(s_after, 0.5 * dt)), phi);
  if (!previous.empty()) equation.laplacian().add(previous, phi);
  if (!equation.solve(phi, closely, carried_impulse(false))) return {"the pressure solve failed"};
  answer_to(phi, s_after);
  push(equation.on_motions(trial.on_walls));
  return {};
}

template <int d>
Status Fluid<d>::State::correct(std::span<const double> previous) {
  auto& r = trial.r;
  const auto& unknown = equation.unknown();
  const std::size_t count = trial.v.size();
  // They start from what they found in the last step, so that they converge over the steps.
  const std::vector<double> uncorrected = phi;
  for (std::size_t i = 0; i < count; ++i)
    if (unknown[i] >= 0) r[unknown[i]] = kick * work.nodes.q[i];
  answer_to(r, s_after);
  for (int i = 0; i < equation.size(); ++i) phi[i] += r[i];
  for (int k = 0;; ++k) {
    v_after = trial.v;
    equation.accelerate(phi, v_after);
    wall_motion->move(v_after, moved_poses(s_after, dt), dt, moved);
    if (k == corrections) break;
    if (wall_motion->drags()) stick(trial.dragged);
    in_parallel(count, [&](std::size_t i) { trial.x_mid[i] = 0.5 * (work.nodes.x[i] + moved.x[i]); });
    equation.motion_residual(trial.x_mid, moved.u, r);
    equation.slide_residual(trial.x_mid, moved.u, s_after, centres(moved_poses(s_after, 0.5 * dt)), moved.slides, r);
    lag(r, previous, phi);
    if (!solve_with_bodies(r, s_after, roughly)) return {"the pressure solve failed"};
    for (int i = 0; i < equation.size(); ++i) phi[i] += r[i];
  }
  found_by_corrections.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
    if (unknown[i] >= 0) found_by_corrections[i] = (phi[unknown[i]] - uncorrected[unknown[i]]) / kick;
  return {};
}

// Loads, pressures and energies of the solution.
template <int d>
void Fluid<d>::State::weigh() {
  interface = equation.laplacian().means(phi);
  loads.assign(walls.size(), {});
  std::vector<Wrench<d>> by_pressure;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wrench<d> repair = equation.impulse(w, trial.repaired), physical = equation.impulse(w, phi);
    loads[w].physical = (physical + trial.on_walls[w] + trial.dragged[w]) / kick;
    loads[w].repair = repair / kick;
    loads[w].wetted = work.wetted[w];
    by_pressure.push_back(repair + physical);
  }
  imbalance.assign(walls.size(), Twist<d>::Zero());
  if (equation.motions() > 0)
    equation.move(equation.response(equation.on_motions(by_pressure) + trial.known - equation.inertia() * trial.answer),
                  imbalance);
  Ledger& ledger = work.ledger;
  power_on_walls = 0;
  for (std::size_t w = 0; w < walls.size(); ++w)
    power_on_walls += loads[w].total().dot(0.5 * (s_after[w] + work.velocity[w]));
  ledger.work_on_walls = now.ledger.work_on_walls + 0.5 * work.dt * power_on_walls;
  ledger.kinetic_energy = ledger.potential_energy = 0;
  for (std::size_t i = 0; i < trial.v.size(); ++i) {
    work.nodes.p[i] = equation.unknown()[i] < 0 ? 0.0 : phi[equation.unknown()[i]] / kick;
    const double mass = spec.density * (work.nodes.spray[i] ? work.nodes.volume[i] : equation.lumped_volume()[i]);
    ledger.kinetic_energy += 0.5 * mass * (0.5 * (work.nodes.v[i] + moved.u[i])).squaredNorm();
    for (const auto& term : terms) ledger.potential_energy += mass * term->potential(work.nodes.x[i]);
  }
}

template <int d>
bool Fluid<d>::State::finite() const {
  double sum = 0;
  for (const auto& v : v_after) sum += v.sum();
  for (const auto& l : loads) sum += l.total().sum();
  return std::isfinite(sum);
}

// Elements that carry pressure deform by a fraction of themselves; `stable_dt` sees to it but for what remeshing
// and contact bring.
template <int d>
bool Fluid<d>::State::orderly() const {
  constexpr double most = 4;  // change of an edge over its length: far beyond any CFL number in use
  const double per_rate = dt / most;
  const double margin = least_in_parallel(work.mesh.cells.size(), [&](std::size_t c) {
    double least = std::numeric_limits<double>::infinity();
    const auto& cell = work.mesh.cells[c];
    if (std::none_of(cell.begin(), cell.end(), [&](int n) { return equation.unknown()[n] >= 0; })) return least;
    for (int i = 0; i < d; ++i)
      for (int j = i + 1; j <= d; ++j) {
        const double change = per_rate * per_rate * (moved.u[cell[i]] - moved.u[cell[j]]).squaredNorm();
        least = std::min(least, squared_length(work, cell[i], cell[j]) - change);
      }
    return least;
  });
  return margin >= 0;
}

// Solves for impulses and lets the motions answer to them.
template <int d>
bool Fluid<d>::State::solve_with_bodies(std::vector<double>& r, std::vector<Twist<d>>& s, double tolerance) {
  if (!equation.solve(r, tolerance)) return false;
  answer_to(r, s);
  return true;
}
template <int d>
void Fluid<d>::State::answer_to(std::vector<double>& impulses, std::vector<Twist<d>>& s) {
  if (equation.motions() > 0) trial.answer += equation.respond(impulses, s, Eigen::VectorXd::Zero(equation.motions()));
}

// A further impulse on the motions: water and bodies answer.
template <int d>
void Fluid<d>::State::push(const Eigen::VectorXd& impulse) {
  if (impulse.isZero(0)) return;
  std::vector<double> none(phi.size(), 0.0);
  trial.known += impulse;
  trial.answer += equation.respond(none, s_after, impulse);
  for (std::size_t i = 0; i < phi.size(); ++i) phi[i] += none[i];
}

// Nodes that stick hand what the pressure and the forces left along their wall over to it. Part of the
// corrections: bodies that respond get the new part of it. Returns the impulses on all walls.
template <int d>
void Fluid<d>::State::stick(std::vector<Wrench<d>>& impulses) {
  std::vector<Wrench<d>> now_on_walls;
  wall_motion->drag(v_after, moved.u, spec.density, equation.lumped_volume(), now_on_walls);
  for (std::size_t w = 0; w < walls.size(); ++w) impulses[w] = now_on_walls[w] - impulses[w];
  push(equation.on_motions(impulses));
  impulses = std::move(now_on_walls);
}

// The first guess of impulses is the pressure of the last step, with what the corrections found and without.
template <int d>
std::vector<double> Fluid<d>::State::carried_impulse(bool corrected) const {
  std::vector<double> carried(equation.size());
  for (std::size_t i = 0; i < carried_p.size(); ++i)
    if (const int k = equation.unknown()[i]; k >= 0)
      carried[k] = kick * (corrected ? carried_p[i] : carried_p[i] - work.nodes.q[i]);
  return carried;
}

template <int d>
double Fluid<d>::State::kinetic_energy(std::span<const Vec<d>> v) const {
  double e = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    e += (work.nodes.spray[i] ? work.nodes.volume[i] : equation.lumped_volume()[i]) * v[i].squaredNorm();
  return 0.5 * spec.density * e;
}

template struct Fluid<2>::State;
template struct Fluid<3>::State;

}  // namespace splashdown::fluid
