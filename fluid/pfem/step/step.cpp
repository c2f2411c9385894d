// The frame of a step: mesh and factor, what comes before the pressure, the first pressure and what it leaves.
#include "fluid/pfem/step/step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr int most_of_law = 12;  // iterations of a step for the law of a liquid with gas

}  // namespace

template <int d>
Status WaterStep<d>::begin(double kick, double dt, const InterfaceModel& structure) {
  kick_ = kick;
  dt_ = dt;
  if (!water_.prepared) water_.prepare();
  {
    const auto scope = water_.timer.scope(assemble);
    wall_motion_.emplace(water_.work.nodes, water_.work.mesh, water_.walls_at(water_.work.poses),
                         walls_that_answer<d>(structure.modal, water_.layout));
    if (!equation_.build(water_.work.nodes, water_.work.mesh, water_.spec.density, water_.work.poses, water_.layout,
                         structure, wall_motion_->held()))
      return {"the pressure matrix could not be factored"};
    wall_motion_->meet_pressure(equation_.unknown(), equation_.lumped_volume());
  }
  for (std::size_t t = 0; t < water_.effects.size(); ++t) {
    const auto scope = water_.timer.scope(first_effect + t);
    if (auto status = water_.effects[t]->begin(view()); !status.ok()) return status;
  }
  return add_pressure_terms();
}

// The matrix stands without them: their diagonal is its own reason to factor once more.
template <int d>
Status WaterStep<d>::add_pressure_terms() {
  terms_ = {};
  for (std::size_t t = 0; t < water_.effects.size(); ++t) {
    const auto scope = water_.timer.scope(first_effect + t);
    water_.effects[t]->pressure(view(), terms_);
  }
  const auto scope = water_.timer.scope(Phase::pressure);
  compression_.begin<d>(terms_.liquid, equation_.lumped_volume(), water_.spec.density, water_.work.nodes.compression,
                        kick_, dt_);
  if (!equation_.set_terms(compression_.diagonal(terms_.diagonal), terms_.source))
    return {"the pressure matrix could not be factored"};
  in_equilibrium_ = false;
  return {};
}

// The first pressure of a compressible liquid has another matrix than its repair.
template <int d>
Status WaterStep<d>::set_equilibrium(bool on) {
  if (!compression_.starts() || in_equilibrium_ == on) return {};
  const auto scope = water_.timer.scope(Phase::pressure);
  in_equilibrium_ = on;
  if (!equation_.set_terms(compression_.diagonal(terms_.diagonal, on), terms_.source))
    return {"the pressure matrix could not be factored"};
  return {};
}

template <int d>
Status WaterStep<d>::carry_compression() {
  if (!compression_) return {};
  if (auto status = set_equilibrium(true); !status.ok()) return status;
  compression_.carry(equation_.lumped_volume(), equation_.unknown(), trial_.repaired);
  damp_compression();
  equation_.set_source(compression_.source(terms_.source));
  return {};
}

template <int d>
void WaterStep<d>::damp_compression() {
  const auto& cells = water_.work.mesh.cells;
  const auto volume_of = equation_.lumped_volume();
  const auto has = [&](int n) { return equation_.unknown()[n] >= 0; };
  std::vector<double> weight(cells.size()), weighted(cells.size());
  in_parallel(cells.size(), [&](std::size_t c) {
    double sum = 0;
    int count = 0;
    for (int n : cells[c])
      if (has(n)) sum += compression_.rate(n, volume_of[n]), ++count;
    weight[c] = count > 0 ? std::max(0.0, volume<d>(corners(water_.work.nodes.x, cells[c]))) : 0.0;
    weighted[c] = count > 0 ? weight[c] * sum / count : 0.0;
  });
  in_parallel(volume_of.size(), [&](std::size_t i) {
    double sum = 0, of_all = 0;
    for (const auto [c, k] : equation_.around().around(i)) sum += weighted[c], of_all += weight[c];
    if (!has(static_cast<int>(i)) || !(of_all > 0)) return;
    compression_.damp(i, compression_.rate(i, volume_of[i]) - sum / of_all, volume_of[i], water_.spec.density,
                      std::pow(of_all / 2, 1.0 / d));
  });
}

template <int d>
StepResult<d> WaterStep<d>::solve(std::span<const WallVelocity<d>> given, std::span<const double> previous,
                                  const ClosedContacts& contacts) {
  StepResult<d> found;
  found.status = find_motion(given, previous, contacts);
  for (int k = 0; found.status.ok(); ++k) {
    if (!compression_.follow_law(equation_.lumped_volume(), equation_.unknown(), trial_.phi)) break;
    if (k == most_of_law)
      found.status = {"the gas in the liquid stiffens faster than the step"};
    else if (!equation_.set_terms(compression_.diagonal(terms_.diagonal), terms_.source))
      found.status = {"the pressure matrix could not be factored"};
    else
      found.status = find_motion(given, previous, contacts);
  }
  if (found.status.ok()) evaluate(found);
  return found;
}

template <int d>
Status WaterStep<d>::find_motion(std::span<const WallVelocity<d>> given, std::span<const double> previous,
                                 const ClosedContacts& contacts) {
  if (previous.size() != equation_.laplacian().pieces().size())
    throw std::invalid_argument("fluid: previous interface impulses must be given where there is a Laplacian");
  trial_.v = water_.work.nodes.v;
  trial_.s_before = water_.work.velocity;
  trial_.x_mid.resize(trial_.v.size());
  trial_.on_walls.assign(water_.walls.size(), Wrench<d>::Zero());
  trial_.known.setZero(equation_.mode_count());
  trial_.unanswered = trial_.answer = trial_.known;
  trial_.following = {};
  // Neither the repair nor effects depend on what is closed, or what closes might have to open for it.
  if (contacts.restrict_modes())
    equation_.allow(Eigen::MatrixXd::Identity(equation_.mode_count(), equation_.mode_count()));
  if (auto status = set_equilibrium(false); !status.ok()) return status;
  if (auto status = repair(); !status.ok()) return status;
  if (auto status = carry_compression(); !status.ok()) return status;
  if (contacts.restrict_modes()) restrict_repair(contacts);
  // Pressure changes no momentum of free water; masses that are held up (PressureEquation) may.
  water_.free_water.give_back(water_.free_carried, equation_.lumped_volume(), trial_.v);
  if (auto status = predict(contacts); !status.ok()) return status;
  trial_.free_water = water_.free_water.moments(equation_.lumped_volume(), trial_.v);
  const auto scope = water_.timer.scope(Phase::pressure);
  if (auto status = solve_pressure(given, previous); !status.ok()) return status;
  apply_body_impulse(contacts.known);
  if (auto status = correct(previous); !status.ok()) return status;
  trial_.handed = equation_.held().excess(trial_.v_after, trial_.s_after);
  return {};
}

// The Laplacian acts on the change since the previous pass, so that it vanishes when passes agree. The repair
// keeps it: it stands for the body's answer, and what it leaves of the flux the pressure finds.
template <int d>
void WaterStep<d>::lag(std::vector<double>& residual, std::span<const double> previous,
                       std::span<const double> present) const {
  if (previous.empty()) return;
  std::vector<double> change = equation_.laplacian().means(present);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] = previous[k] - change[k];
  equation_.laplacian().add(change, residual);
}

// Closed contacts take what would open or close them of the bodies' answer to the repair: it is not a motion but an impulse.
template <int d>
void WaterStep<d>::restrict_repair(const ClosedContacts& contacts) {
  equation_.allow(contacts.directions, contacts.workless);
  const Eigen::VectorXd kept = contacts.allowed(trial_.answer);
  trial_.unanswered = equation_.inertia() * (trial_.answer - kept);
  equation_.move(kept - trial_.answer, trial_.s_before);
  trial_.answer = kept;
}

template <int d>
Status WaterStep<d>::predict(const ClosedContacts& contacts) {
  auto& carried = trial_.carried;
  carried.clear();
  if (!water_.effects.empty()) {
    const auto scope = water_.timer.scope(momentum);
    carried = trial_.v;
  }
  trial_.carried_walls = trial_.s_before;
  Eigen::VectorXd answer = Eigen::VectorXd::Zero(equation_.mode_count());
  trial_.booked.clear();
  for (std::size_t t = 0; t < water_.effects.size(); ++t) {
    const auto scope = water_.timer.scope(first_effect + t);
    const bool answers = equation_.mode_count() > 0, books = water_.effects[t]->books_work();
    const bool follows = solves_all() && water_.effects[t]->follows();
    auto& following = trial_.following;
    if (follows && following.change.empty()) {
      following.change.assign(trial_.v.size(), Vec<d>::Zero());
      following.on_walls.assign(water_.walls.size(), Wrench<d>::Zero());
    }
    const std::vector<Vec<d>> v_before = follows ? trial_.v : std::vector<Vec<d>>();
    const std::vector<WallImpulse<d>> on_walls_before = follows ? trial_.on_walls : std::vector<WallImpulse<d>>();
    if (books) trial_.booked.push_back({t, trial_.v, trial_.on_walls});
    if (auto status =
            water_.effects[t]->predict(view(answers ? &equation_.modal() : nullptr), {carried, trial_.carried_walls},
                                       {trial_.v, trial_.on_walls, answers ? &answer : nullptr});
        !status.ok())
      return status;
    for (std::size_t i = 0; i < v_before.size(); ++i) following.change[i] += trial_.v[i] - v_before[i];
    for (std::size_t w = 0; w < on_walls_before.size(); ++w)
      following.on_walls[w] += trial_.on_walls[w] - on_walls_before[w];
    if (!books) continue;
    auto& booked = trial_.booked.back();
    in_parallel(trial_.v.size(), [&](std::size_t i) { booked.change[i] = trial_.v[i] - booked.change[i]; });
    for (std::size_t w = 0; w < water_.walls.size(); ++w) booked.on_walls[w] = trial_.on_walls[w] - booked.on_walls[w];
  }
  push_surface();
  if (equation_.mode_count() == 0) return {};
  if (has_followers())
    trial_.following.given = trial_.following.answered = equation_.on_modes(trial_.following.on_walls);
  // Closed contacts do not change what effects do: their impulses balance it with the pressure's.
  answer = contacts.allowed(answer);
  const Eigen::VectorXd impulse = equation_.on_modes(trial_.on_walls);
  trial_.known += impulse;
  trial_.answer += answer;
  equation_.move(answer, trial_.s_before);
  trial_.unanswered += impulse - equation_.inertia() * answer;
  return {};
}

template <int d>
void WaterStep<d>::push_surface() {
  trial_.of_surface.clear();
  if (terms_.surface_pressure.empty()) return;
  const auto scope = water_.timer.scope(Phase::pressure);
  for (const double p : terms_.surface_pressure) trial_.of_surface.push_back(kick_ * p);
  trial_.of_surface = equation_.continued(trial_.of_surface);
  equation_.push(trial_.of_surface, trial_.v, water_.work.poses, trial_.on_walls);
}

// The motion to t_{n+1} creates no volume either. s includes the repair's push on bodies.
template <int d>
Status WaterStep<d>::solve_pressure(std::span<const WallVelocity<d>> given, std::span<const double> previous) {
  trial_.s_after.assign(given.begin(), given.end());
  for (std::size_t w = 0; w < water_.walls.size(); ++w)
    trial_.s_after[w] += trial_.s_before[w] - water_.work.velocity[w];
  trial_.s_unloaded = trial_.s_after;
  middle(trial_.v, judged_at() * dt_);
  equation_.flux_residual(trial_.x_mid, trial_.v, trial_.s_after, water_.moved_poses(trial_.s_after, judged_at() * dt_),
                          trial_.phi);
  if (!previous.empty()) equation_.laplacian().add(previous, trial_.phi);
  equation_.add_sources(trial_.phi);
  if (!equation_.solve(trial_.phi, closely, carried_impulse())) return {"the pressure solve failed"};
  answer_to(trial_.phi, trial_.s_after, equation_.on_modes(equation_.held().excess(trial_.v, trial_.s_after)));
  let_bodies_answer(trial_.unanswered);
  return {};
}

// The motion that the impulses found so far give the nodes.
template <int d>
bool WaterStep<d>::move_nodes() {
  trial_.v_after = trial_.v;
  equation_.accelerate(trial_.phi, trial_.v_after);
  if (has_followers() && !follow()) return false;
  wall_motion_->move(trial_.v_after, water_.moved_poses(trial_.s_after, dt_), dt_, trial_.moved);
  return true;
}

// They act on the carried velocities and on what all else has changed in them, instead of what they did before the pressure.
template <int d>
bool WaterStep<d>::follow() {
  auto& following = trial_.following;
  const std::size_t count = trial_.v.size();
  std::vector<Vec<d>> others(count), change(count, Vec<d>::Zero());
  in_parallel(count, [&](std::size_t i) { others[i] = trial_.v_after[i] - trial_.carried[i] - following.change[i]; });
  std::vector<WallImpulse<d>> on_walls(water_.walls.size(), Wrench<d>::Zero());
  for (std::size_t t = 0; t < water_.effects.size(); ++t) {
    if (!water_.effects[t]->follows()) continue;
    const auto scope = water_.timer.scope(first_effect + t);
    if (!water_.effects[t]
             ->follow(view(), {trial_.carried, trial_.carried_walls}, {others, trial_.s_after},
                      {change, on_walls, nullptr})
             .ok())
      return false;
  }
  in_parallel(count, [&](std::size_t i) { trial_.v_after[i] = trial_.carried[i] + others[i] + change[i]; });
  for (std::size_t w = 0; w < on_walls.size(); ++w) trial_.on_walls[w] += on_walls[w] - following.on_walls[w];
  if (equation_.mode_count() > 0) {
    const Eigen::VectorXd now = equation_.on_modes(on_walls);
    trial_.known += now - equation_.on_modes(following.on_walls);
    in_parallel(count, [&](std::size_t i) { change[i] -= following.change[i]; });
    const std::vector<WallVelocity<d>> still(water_.walls.size(), Twist<d>::Zero());
    following.given = now + equation_.on_modes(equation_.held().excess(change, still));
  }
  following.on_walls = on_walls;
  return true;
}

// What an iteration leaves is not left to Newton's law: with the impulses that effects have found last, bodies obey it to
// roundoff, and the water feels the difference as a pressure.
template <int d>
void WaterStep<d>::settle_bodies() {
  if (!has_followers() || equation_.mode_count() == 0) return;
  auto& following = trial_.following;
  std::vector<double> further(trial_.phi.size(), 0.0);
  trial_.answer += equation_.respond(further, trial_.s_after, following.given - following.answered);
  following.answered = following.given;
  for (std::size_t i = 0; i < further.size(); ++i) trial_.phi[i] += further[i];
  equation_.accelerate(further, trial_.v_after);
  wall_motion_->move(trial_.v_after, water_.moved_poses(trial_.s_after, dt_), dt_, trial_.moved);
}

template <int d>
std::vector<Vec<d>> WaterStep<d>::pushed() const {
  std::vector<Vec<d>> change(trial_.v.size(), Vec<d>::Zero());
  equation_.accelerate(trial_.phi, change);
  return change;
}

// The volume that this motion creates.
template <int d>
void WaterStep<d>::what_is_left(std::span<const double> previous, std::vector<double>& residual) {
  const double share = judged_at();
  in_parallel(trial_.v.size(), [&](std::size_t i) {
    trial_.x_mid[i] = share < 1 ? Vec<d>(0.5 * (water_.work.nodes.x[i] + trial_.moved.x[i])) : trial_.moved.x[i];
  });
  equation_.motion_residual(trial_.x_mid, trial_.moved.u, residual);
  equation_.slide_residual(trial_.x_mid, trial_.moved.u, trial_.s_after,
                           water_.moved_poses(trial_.s_after, share * dt_), trial_.moved.slides, residual);
  lag(residual, previous, trial_.phi);
  equation_.add_sources(residual, trial_.phi);
}

// What a residual asks for, and how walls answer to it.
template <int d>
Status WaterStep<d>::ask(Correction<d>& left) {
  left.impulse = left.residual;
  left.walls.assign(water_.walls.size(), Twist<d>::Zero());
  if (!equation_.solve(left.impulse, roughly)) return {"the pressure solve failed"};
  Eigen::VectorXd owed = Eigen::VectorXd::Zero(equation_.mode_count());
  if (has_followers()) {
    add_viscous_part(left);
    left.owed = owed = trial_.following.given - trial_.following.answered;
    left.owed_answer = equation_.response(owed);
  }
  left.answer = equation_.respond(left.impulse, left.walls, owed);
  return {};
}

// Where viscosity makes the motion, an impulse takes out r = V phi / (2 mu kick), not A phi (Cahouet, Chabard 1988).
template <int d>
void WaterStep<d>::add_viscous_part(Correction<d>& left) const {
  double diffusivity = 0;
  for (const auto& effect : water_.effects) diffusivity += effect->diffusivity(water_.spec.density);
  const double scale = 2 * water_.spec.density * diffusivity * kick_;
  for (std::size_t i = 0; i < trial_.v.size(); ++i)
    if (const int k = equation_.unknown()[i]; k >= 0)
      left.impulse[k] += scale * left.residual[k] / equation_.lumped_volume()[i];
}

template <int d>
typename WaterStep<d>::Unrepaired WaterStep<d>::begin_repair() {
  trial_.repaired.assign(equation_.size(), 0.0);
  trial_.repair_handed.assign(water_.walls.size(), Wrench<d>::Zero());
  const double energy = equation_.kinetic_energy(trial_.v), drops = energy_of_drops(trial_.v);
  trial_.energy_before = energy + drops;
  return {trial_.s_before, trial_.v, trial_.answer, energy, drops};
}

// The carried velocity's flux, seen at t_{n-1/2} on the new mesh.
template <int d>
void WaterStep<d>::flux_before(std::vector<double>& residual, std::span<const double> impulses,
                               const Unrepaired* seen) {
  const double back = (judged_at() - 1) * water_.work.dt;
  middle(seen ? seen->free : trial_.v, back);
  equation_.flux_residual(trial_.x_mid, trial_.v, trial_.s_before,
                          water_.moved_poses(seen ? seen->s : trial_.s_before, back), residual);
  compression_.take_from(residual, equation_.lumped_volume(), equation_.unknown(), impulses);
}

// It is a projection: what it gives to the water it takes from bodies. Where films are worn to nodes of hardly any mass
// the truncated one may not be, and counts by a half, a quarter, not at all.
template <int d>
void WaterStep<d>::take_repair(Unrepaired& from, std::vector<double>& impulses, std::vector<Vec<d>>& free,
                               std::span<const WallImpulse<d>> handed) {
  const auto& held = equation_.held();
  auto& s = trial_.s_before;
  double taken = 1, energy = 0;
  auto settle = [&] {
    trial_.v = free;
    held.hold(trial_.v, s);
    energy = equation_.kinetic_energy(trial_.v);
  };
  auto gains = [&] {
    double given = work_of(impulses, from.s, s);
    for (std::size_t w = 0; w < handed.size(); ++w) given += taken * handed[w].dot(0.5 * (from.s[w] + s[w]));
    return energy + given > from.energy + most_gain * (from.energy + std::abs(given));
  };
  settle();
  while (taken > 0 && gains()) {
    const double less = taken > 0.25 ? 0.5 : 0.0;
    taken *= less;
    for (double& impulse : impulses) impulse *= less;
    for (std::size_t w = 0; w < s.size(); ++w) s[w] = from.s[w] + less * (s[w] - from.s[w]);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = from.free[i] + less * (free[i] - from.free[i]);
    trial_.answer = from.answer + less * (trial_.answer - from.answer);
    settle();
  }
  for (std::size_t w = 0; w < handed.size(); ++w) trial_.repair_handed[w] += taken * handed[w];
  for (int i = 0; i < equation_.size(); ++i) trial_.repaired[i] += impulses[i];
  from = {s, free, trial_.answer, energy, from.drops};
  trial_.energy_repaired = energy + from.drops;
}

template <int d>
void WaterStep<d>::apply(const Correction<d>& correction, double share) {
  for (std::size_t i = 0; i < trial_.phi.size(); ++i) trial_.phi[i] += share * correction.impulse[i];
  for (std::size_t w = 0; w < water_.walls.size(); ++w) trial_.s_after[w] += share * correction.walls[w];
  if (equation_.mode_count() > 0) trial_.answer += share * correction.answer;
  if (correction.owed.size() > 0) trial_.following.answered += share * correction.owed;
}

// Lets the motions answer to impulses.
template <int d>
void WaterStep<d>::answer_to(std::vector<double>& impulses, std::vector<WallVelocity<d>>& s,
                             const Eigen::VectorXd& further) {
  if (equation_.mode_count() > 0) trial_.answer += equation_.respond(impulses, s, further);
}

// A further impulse on the motions.
template <int d>
void WaterStep<d>::apply_body_impulse(const Eigen::VectorXd& impulse) {
  if (impulse.size() > 0) trial_.known += impulse;
  let_bodies_answer(impulse);
}

// Water and bodies answer to an impulse on the motions.
template <int d>
void WaterStep<d>::let_bodies_answer(const Eigen::VectorXd& impulse) {
  if (impulse.isZero(0)) return;
  std::vector<double> none(trial_.phi.size(), 0.0);
  trial_.answer += equation_.respond(none, trial_.s_after, impulse);
  for (std::size_t i = 0; i < trial_.phi.size(); ++i) trial_.phi[i] += none[i];
}

// The first guess of impulses is the pressure of the last step.
template <int d>
std::vector<double> WaterStep<d>::carried_impulse() const {
  std::vector<double> carried(equation_.size());
  for (std::size_t i = 0; i < water_.work.nodes.size(); ++i)
    if (const int k = equation_.unknown()[i]; k >= 0) carried[k] = kick_ * water_.work.nodes.p[i];
  return carried;
}

// Of pressure impulses on walls that change their velocities from s_0 to s_1.
template <int d>
double WaterStep<d>::work_of(std::span<const double> impulses, std::span<const WallVelocity<d>> s_0,
                             std::span<const WallVelocity<d>> s_1) const {
  double work_done = 0;
  for (std::size_t w = 0; w < s_0.size(); ++w) work_done += equation_.impulse(w, impulses).dot(0.5 * (s_0[w] + s_1[w]));
  return work_done;
}

template <int d>
double WaterStep<d>::energy_of_drops(std::span<const Vec<d>> v) const {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (water_.work.nodes.spray[i]) sum += water_.work.nodes.volume[i] * v[i].squaredNorm();
  return 0.5 * water_.spec.density * sum;
}

// What terms of effects make of the volume of nodes; empty: nothing.
template <int d>
std::vector<double> WaterStep<d>::meant_volumes() const {
  if (terms_.source.empty() && terms_.diagonal.empty() && !compression_) return {};
  std::vector<double> rate(static_cast<std::size_t>(equation_.size()), 0.0), meant(water_.work.nodes.size(), 0.0);
  equation_.add_sources(rate, trial_.phi);
  for (std::size_t i = 0; i < meant.size(); ++i)
    if (const int k = equation_.unknown()[i]; k >= 0) meant[i] = dt_ * rate[k];
  return meant;
}

template <int d>
Motion<d> WaterStep<d>::taken(const StepResult<d>& found) {
  for (const auto& effect : water_.effects) effect->commit(view());
  return {.kick = kick_,
          .dt = dt_,
          .found = found,
          .at_walls = *wall_motion_,
          .v = trial_.v_after,
          .around = equation_.around(),
          .lumped_volume = equation_.lumped_volume(),
          .unknown = equation_.unknown(),
          .repaired = trial_.repaired,
          .unloaded = trial_.free_water,
          .meant = meant_volumes(),
          .compression = compression_.after(equation_.lumped_volume(), equation_.unknown(), trial_.phi),
          .energy_of_repair = trial_.energy_repaired - trial_.energy_before};
}

template class WaterStep<2>;
template class WaterStep<3>;

}  // namespace splashdown::fluid
