// The motion over a step: repair, effects, pressure, corrections, and what they load walls with.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fluid/pfem/fluid_state.hpp"
#include "fluid/pfem/linear/conjugate_residual.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr int repairs = 2;
// Tolerances of iterative solves. Each pass of the repair and of the corrections leaves a tenth of the residual anyhow;
// the pressure solve takes out what the repair leaves of the flux, the corrections what the pressure solve leaves.
constexpr double closely = 1e-4, roughly = 1e-2;
// Of a velocity: what sums over its neighbours round off. Corrections below it have no direction.
constexpr double roundoff = 1e-12;

}  // namespace

template <int d>
StepResult<d> Fluid<d>::State::solve(std::span<const Twist<d>> given, std::span<const double> previous,
                                     const ClosedContacts& contacts) {
  StepResult<d> found;
  found.status = find_motion(given, previous, contacts);
  if (found.status.ok()) evaluate(found);
  return found;
}

template <int d>
Status Fluid<d>::State::find_motion(std::span<const Twist<d>> given, std::span<const double> previous,
                                    const ClosedContacts& contacts) {
  if (previous.size() != equation.laplacian().pieces().size())
    throw std::invalid_argument("fluid: previous interface impulses must be given where there is a Laplacian");
  trial.v = work.nodes.v;
  trial.s_before = work.velocity;
  trial.x_mid.resize(trial.v.size());
  trial.on_walls.assign(walls.size(), Wrench<d>::Zero());
  trial.known.setZero(equation.mode_count());
  trial.unanswered = trial.answer = trial.known;
  // Neither the repair nor effects depend on what is closed, or what closes might have to open for it.
  if (contacts.restrict_modes())
    equation.allow(Eigen::MatrixXd::Identity(equation.mode_count(), equation.mode_count()));
  if (auto status = repair(); !status.ok()) return status;
  if (contacts.restrict_modes()) restrict_repair(contacts);
  // Pressure changes no momentum of free water; masses that are held up (PressureEquation) may.
  free_water.give_back(free_carried, equation.lumped_volume(), trial.v);
  if (auto status = predict(contacts); !status.ok()) return status;
  trial.free_water = free_water.moments(equation.lumped_volume(), trial.v);
  const auto scope = timer.scope(Phase::pressure);
  if (auto status = solve_pressure(given, previous); !status.ok()) return status;
  apply_body_impulse(contacts.known);
  if (auto status = correct(previous); !status.ok()) return status;
  trial.handed = equation.held().excess(trial.v_after, trial.s_after);
  return {};
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

// Closed contacts take what would open or close them of the bodies' answer to the repair: it is not a motion but an impulse.
template <int d>
void Fluid<d>::State::restrict_repair(const ClosedContacts& contacts) {
  equation.allow(contacts.directions, contacts.workless);
  const Eigen::VectorXd kept = contacts.allowed(trial.answer);
  trial.unanswered = equation.inertia() * (trial.answer - kept);
  equation.move(kept - trial.answer, trial.s_before);
  trial.answer = kept;
}

// The carried velocity, seen at t_{n-1/2} on the new mesh, creates no volume. Nodes that have come to a wall's edge since
// then share their momentum with it.
template <int d>
Status Fluid<d>::State::repair() {
  const auto scope = timer.scope(Phase::pressure);
  auto& v = trial.v;
  auto& r = trial.r;
  auto& s_before = trial.s_before;
  const auto& held = equation.held();
  trial.repaired.assign(equation.size(), 0.0);
  trial.repair_handed.assign(walls.size(), Wrench<d>::Zero());
  Eigen::VectorXd excess = equation.on_modes(held.excess(v, s_before));
  std::vector<Vec<d>> free = v;  // as if no wall held them
  double energy = equation.kinetic_energy(v);
  const double drops = energy_of_drops(v);
  trial.energy_before = energy + drops;
  for (int k = 0; k < repairs; ++k) {
    middle(v, -0.5 * work.dt);
    equation.flux_residual(trial.x_mid, v, s_before, centres(moved_poses(s_before, -0.5 * work.dt)), r);
    if (!equation.solve(r, roughly)) return {"the pressure solve failed"};
    const auto s_0 = s_before;
    const auto free_0 = free;
    const Eigen::VectorXd answer_0 = trial.answer;
    const double energy_0 = energy;
    auto handed = held.excess(free, s_before);
    answer_to(r, s_before, excess);
    excess.setZero();  // what follows is linear, and answered with the pressure
    equation.accelerate(r, free);
    const auto handed_after = held.excess(free, s_before);
    for (std::size_t w = 0; w < handed.size(); ++w) handed[w] = handed_after[w] - (k > 0) * handed[w];
    v = free;
    held.hold(v, s_before);
    // It is a projection: what it gives to the water it takes from bodies. Where films are worn to nodes of hardly any mass
    // the truncated one may not be, and counts by a half, a quarter, not at all.
    double taken = 1;
    auto gains = [&] {
      double given = work_of(r, s_0, s_before);
      for (std::size_t w = 0; w < handed.size(); ++w) given += taken * handed[w].dot(0.5 * (s_0[w] + s_before[w]));
      return energy + given > energy_0 + most_gain * (energy_0 + std::abs(given));
    };
    energy = equation.kinetic_energy(v);
    while (taken > 0 && gains()) {
      const double less = taken > 0.25 ? 0.5 : 0.0;
      taken *= less;
      for (double& impulse : r) impulse *= less;
      for (std::size_t w = 0; w < s_0.size(); ++w) s_before[w] = s_0[w] + less * (s_before[w] - s_0[w]);
      for (std::size_t i = 0; i < v.size(); ++i) free[i] = free_0[i] + less * (free[i] - free_0[i]);
      trial.answer = answer_0 + less * (trial.answer - answer_0);
      v = free;
      held.hold(v, s_before);
      energy = equation.kinetic_energy(v);
    }
    for (std::size_t w = 0; w < handed.size(); ++w) trial.repair_handed[w] += taken * handed[w];
    for (int i = 0; i < equation.size(); ++i) trial.repaired[i] += r[i];
  }
  trial.energy_repaired = energy + drops;
  return {};
}

template <int d>
Status Fluid<d>::State::predict(const ClosedContacts& contacts) {
  std::vector<Vec<d>> carried;
  if (!effects.empty()) {
    const auto scope = timer.scope(momentum);
    carried = trial.v;
  }
  const std::vector<Twist<d>> carried_walls = trial.s_before;
  Eigen::VectorXd answer = Eigen::VectorXd::Zero(equation.mode_count());
  trial.booked.clear();
  for (std::size_t t = 0; t < effects.size(); ++t) {
    const auto scope = timer.scope(first_effect + t);
    const bool answers = equation.mode_count() > 0, books = effects[t]->books_work();
    if (books) trial.booked.push_back({t, trial.v, trial.on_walls});
    if (auto status = effects[t]->predict(view(answers ? &equation.modal() : nullptr), {carried, carried_walls},
                                          {trial.v, trial.on_walls, answers ? &answer : nullptr});
        !status.ok())
      return status;
    if (!books) continue;
    auto& booked = trial.booked.back();
    in_parallel(trial.v.size(), [&](std::size_t i) { booked.change[i] = trial.v[i] - booked.change[i]; });
    for (std::size_t w = 0; w < walls.size(); ++w) booked.on_walls[w] = trial.on_walls[w] - booked.on_walls[w];
  }
  push_surface();
  if (equation.mode_count() == 0) return {};
  // Closed contacts do not change what effects do: their impulses balance it with the pressure's.
  answer = contacts.allowed(answer);
  const Eigen::VectorXd impulse = equation.on_modes(trial.on_walls);
  trial.known += impulse;
  trial.answer += answer;
  equation.move(answer, trial.s_before);
  trial.unanswered += impulse - equation.inertia() * answer;
  return {};
}

template <int d>
void Fluid<d>::State::push_surface() {
  trial.of_surface.clear();
  if (terms.surface_pressure.empty()) return;
  const auto scope = timer.scope(Phase::pressure);
  for (const double p : terms.surface_pressure) trial.of_surface.push_back(kick * p);
  trial.of_surface = equation.continued(trial.of_surface);
  equation.push(trial.of_surface, trial.v, centres(work.poses), trial.on_walls);
}

// The motion to t_{n+1} creates no volume either. s includes the repair's push on bodies.
template <int d>
Status Fluid<d>::State::solve_pressure(std::span<const Twist<d>> given, std::span<const double> previous) {
  trial.s_after.assign(given.begin(), given.end());
  for (std::size_t w = 0; w < walls.size(); ++w) trial.s_after[w] += trial.s_before[w] - work.velocity[w];
  trial.s_unloaded = trial.s_after;
  middle(trial.v, 0.5 * dt);
  equation.flux_residual(trial.x_mid, trial.v, trial.s_after, centres(moved_poses(trial.s_after, 0.5 * dt)), trial.phi);
  if (!previous.empty()) equation.laplacian().add(previous, trial.phi);
  equation.add_sources(trial.phi);
  if (!equation.solve(trial.phi, closely, carried_impulse())) return {"the pressure solve failed"};
  answer_to(trial.phi, trial.s_after, equation.on_modes(equation.held().excess(trial.v, trial.s_after)));
  let_bodies_answer(trial.unanswered);
  return {};
}

// The motion that the impulses found so far give the nodes.
template <int d>
void Fluid<d>::State::move_nodes() {
  trial.v_after = trial.v;
  equation.accelerate(trial.phi, trial.v_after);
  wall_motion->move(trial.v_after, moved_poses(trial.s_after, dt), dt, trial.moved);
}

// The volume that this motion creates, and what it asks for.
template <int d>
Status Fluid<d>::State::what_is_left(std::span<const double> previous, Correction<d>& left) {
  in_parallel(trial.v.size(), [&](std::size_t i) { trial.x_mid[i] = 0.5 * (work.nodes.x[i] + trial.moved.x[i]); });
  equation.motion_residual(trial.x_mid, trial.moved.u, left.residual);
  equation.slide_residual(trial.x_mid, trial.moved.u, trial.s_after, centres(moved_poses(trial.s_after, 0.5 * dt)),
                          trial.moved.slides, left.residual);
  lag(left.residual, previous, trial.phi);
  equation.add_sources(left.residual, trial.phi);
  left.impulse = left.residual;
  left.walls.assign(walls.size(), Twist<d>::Zero());
  if (!equation.solve(left.impulse, roughly)) return {"the pressure solve failed"};
  left.answer = equation.respond(left.impulse, left.walls, Eigen::VectorXd::Zero(equation.mode_count()));
  return {};
}

// The matrix stands for what `accelerate` and `move` make of an impulse, and is the preconditioner of what they make of it.
template <int d>
Status Fluid<d>::State::correct(std::span<const double> previous) {
  trial.uncorrected = trial.phi;
  Correction<d> left;
  move_nodes();
  if (auto status = what_is_left(previous, left); !status.ok()) return status;
  trial.energy_unloaded = equation.kinetic_energy(trial.v);
  const double least = roundoff * roundoff * trial.energy_unloaded;
  ConjugateResidual<Correction<d>> iteration(left);
  for (int k = 1; k < corrections<d> && iteration.size() > least; ++k) {
    const Correction<d> tried = iteration.left();
    apply(tried, 1);
    move_nodes();
    if (auto status = what_is_left(previous, left); !status.ok()) return status;
    iteration.step(left);
    apply(tried, -1);
    apply(iteration.last(), 1);
  }
  apply(iteration.left(), std::clamp(iteration.share(), 0.0, 1.0));
  move_nodes();
  return {};
}

// Loads, pressures and energies of the solution.
template <int d>
void Fluid<d>::State::evaluate(StepResult<d>& found) {
  const auto scope = timer.scope(Phase::pressure);
  found.wall_velocities = trial.s_after;
  found.velocity = trial.moved.u;
  found.interface_impulse = equation.laplacian().means(trial.phi);
  evaluate_loads(found);
  evaluate_pressure(found);
  evaluate_energies(found);
  found.status = finite(found);
}

template <int d>
void Fluid<d>::State::evaluate_loads(StepResult<d>& found) const {
  found.loads.assign(walls.size(), {});
  std::vector<Wrench<d>> answered;  // with the pressure
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wrench<d> repair = equation.impulse(w, trial.repaired), physical = equation.impulse(w, trial.phi);
    WallLoad<d>& load = found.loads[w];
    load.physical = (physical + trial.on_walls[w] + trial.handed[w]) / kick;
    load.repair = (repair + trial.repair_handed[w]) / kick;
    load.wetted = work.wetted[w];
    found.power_on_walls += load.total().dot(0.5 * (trial.s_after[w] + work.velocity[w]));
    answered.push_back(repair + physical + trial.handed[w] + trial.repair_handed[w]);
  }
  found.imbalance.assign(walls.size(), Twist<d>::Zero());
  if (equation.mode_count() > 0)
    equation.move(equation.response(equation.on_modes(answered) + trial.known - equation.inertia() * trial.answer),
                  found.imbalance);
}

// The corrections' operator D M^-1 D^T hardly sees pressures that change their sign from node to node, so that what it makes of
// noise has them; the Laplacian of the pressure solve allows none. What a step reports is
//
//   p = (phi_0 + S (phi - phi_0)) / kick,   (S q)_i = sum_c V_c mean_c(q) / sum_c V_c
//
// over the cells around a node: loads and motions are those of phi.
template <int d>
void Fluid<d>::State::evaluate_pressure(StepResult<d>& found) const {
  const std::size_t count = work.nodes.size();
  found.carried.assign(count, 0.0);
  found.repair_pressure.assign(count, 0.0);
  std::vector<double> corrected(count, 0.0);  // by, [Pa s]
  for (std::size_t i = 0; i < count; ++i) {
    const int k = equation.unknown()[i];
    if (k < 0) continue;
    found.carried[i] = trial.phi[k] / kick;
    found.repair_pressure[i] = trial.repaired[k] / kick;
    corrected[i] = trial.phi[k] - trial.uncorrected[k];
  }
  const auto& cells = work.mesh.cells;
  std::vector<double> weight(cells.size()), weighted(cells.size());
  in_parallel(cells.size(), [&](std::size_t c) {
    double mean = 0;
    for (int n : cells[c]) mean += corrected[n] / (d + 1);
    weight[c] = std::max(0.0, volume<d>(corners(work.nodes.x, cells[c])));
    weighted[c] = weight[c] * mean;
  });
  found.pressure.assign(count, 0.0);
  in_parallel(count, [&](std::size_t i) {
    if (equation.unknown()[i] < 0) return;
    double sum = 0, of_all = 0;
    for (const auto [c, k] : equation.around().around(i)) sum += weighted[c], of_all += weight[c];
    const double smooth = of_all > 0 ? sum / of_all : 0.0;
    found.pressure[i] = found.carried[i] + (smooth - corrected[i]) / kick;
  });
  for (std::size_t i = 0; i < trial.of_surface.size(); ++i) found.pressure[i] += trial.of_surface[i] / kick;
}

template <int d>
void Fluid<d>::State::evaluate_energies(StepResult<d>& found) const {
  const Nodes<d>& nodes = work.nodes;
  Ledger& ledger = found.ledger;
  ledger = work.ledger;
  ledger.work_on_walls += 0.5 * work.dt * found.power_on_walls;
  evaluate_work(found);
  for (const double power : found.power_of_effects) ledger.work_of_effects += 0.5 * work.dt * power;
  ledger.kinetic_energy = 0;
  ledger.potential_energy = ledger.chord_energy;
  std::vector<Vec<d>> v_n(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double mass = spec.density * (nodes.spray[i] ? nodes.volume[i] : equation.lumped_volume()[i]);
    v_n[i] = at_t_n(nodes.v[i], found.velocity[i]);
    if (nodes.spray[i]) ledger.kinetic_energy += 0.5 * mass * v_n[i].squaredNorm();
    for (const auto& effect : effects) ledger.potential_energy += mass * effect->potential(nodes.x[i]);
  }
  ledger.kinetic_energy += equation.kinetic_energy(v_n);
}

// T(a + dv/2) - T(a - dv/2) with the mean a of the velocities before and after the step: what the change dv brings beside the
// pressure, with the mass that the pressure moves. Walls give the rest.
template <int d>
void Fluid<d>::State::evaluate_work(StepResult<d>& found) const {
  found.power_of_effects.clear();
  if (trial.booked.empty()) return;
  std::vector<Vec<d>> low(trial.v.size()), high(trial.v.size());
  for (const auto& booked : trial.booked) {
    in_parallel(low.size(), [&](std::size_t i) {
      const Vec<d> mean = 0.5 * (work.nodes.v[i] + found.velocity[i]), half = 0.5 * booked.change[i];
      low[i] = mean - half, high[i] = mean + half;
    });
    double given = equation.kinetic_energy(high) - equation.kinetic_energy(low);
    given += energy_of_drops(high) - energy_of_drops(low);
    for (std::size_t w = 0; w < walls.size(); ++w)
      given += booked.on_walls[w].dot(0.5 * (trial.s_after[w] + work.velocity[w]));
    found.power_of_effects.push_back(given / kick);
  }
}

template <int d>
void Fluid<d>::State::apply(const Correction<d>& correction, double share) {
  for (std::size_t i = 0; i < trial.phi.size(); ++i) trial.phi[i] += share * correction.impulse[i];
  for (std::size_t w = 0; w < walls.size(); ++w) trial.s_after[w] += share * correction.walls[w];
  if (equation.mode_count() > 0) trial.answer += share * correction.answer;
}

// Lets the motions answer to impulses.
template <int d>
void Fluid<d>::State::answer_to(std::vector<double>& impulses, std::vector<Twist<d>>& s,
                                const Eigen::VectorXd& further) {
  if (equation.mode_count() > 0) trial.answer += equation.respond(impulses, s, further);
}

// A further impulse on the motions.
template <int d>
void Fluid<d>::State::apply_body_impulse(const Eigen::VectorXd& impulse) {
  if (impulse.size() > 0) trial.known += impulse;
  let_bodies_answer(impulse);
}

// Water and bodies answer to an impulse on the motions.
template <int d>
void Fluid<d>::State::let_bodies_answer(const Eigen::VectorXd& impulse) {
  if (impulse.isZero(0)) return;
  std::vector<double> none(trial.phi.size(), 0.0);
  trial.answer += equation.respond(none, trial.s_after, impulse);
  for (std::size_t i = 0; i < trial.phi.size(); ++i) trial.phi[i] += none[i];
}

// The first guess of impulses is the pressure of the last step.
template <int d>
std::vector<double> Fluid<d>::State::carried_impulse() const {
  std::vector<double> carried(equation.size());
  for (std::size_t i = 0; i < work.nodes.size(); ++i)
    if (const int k = equation.unknown()[i]; k >= 0) carried[k] = kick * work.nodes.p[i];
  return carried;
}

// Of pressure impulses on walls that change their velocities from s_0 to s_1.
template <int d>
double Fluid<d>::State::work_of(std::span<const double> impulses, std::span<const Twist<d>> s_0,
                                std::span<const Twist<d>> s_1) const {
  double work_done = 0;
  for (std::size_t w = 0; w < s_0.size(); ++w) work_done += equation.impulse(w, impulses).dot(0.5 * (s_0[w] + s_1[w]));
  return work_done;
}

template <int d>
double Fluid<d>::State::energy_of_drops(std::span<const Vec<d>> v) const {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (work.nodes.spray[i]) sum += work.nodes.volume[i] * v[i].squaredNorm();
  return 0.5 * spec.density * sum;
}

template struct Fluid<2>::State;
template struct Fluid<3>::State;

}  // namespace splashdown::fluid
