#include "fluid/fluid.hpp"

#include <algorithm>
#include <cereal/archives/binary.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fluid/adapt.hpp"
#include "fluid/contact.hpp"
#include "fluid/delaunay.hpp"
#include "fluid/initial.hpp"
#include "fluid/landing.hpp"
#include "fluid/parallel.hpp"
#include "fluid/size_field.hpp"
#include "fluid/timer.hpp"

namespace splashdown::fluid {
namespace {

enum Phase : std::size_t { remesh, assemble, momentum, pressure, motion, effects };  // effects: the first term

// What a checkpoint holds: everything at t_n that the next step is computed from.
template <int d>
struct Present {
  double time = 0, dt = 0;  // dt: of the step that led here
  Nodes<d> nodes;
  std::vector<double> h;  // element size at the nodes
  Mesh<d> mesh;
  std::vector<Isometry<d>> poses;
  std::vector<Twist<d>> velocity;  // of walls, at t_{n-1/2}
  std::vector<double> wetted;
  double acceleration_dt = std::numeric_limits<double>::infinity();
  Ledger ledger;
};

// What one solve works with.
template <int d>
struct Trial {
  std::vector<Vec<d>> v;                     // of nodes, before the pressure
  std::vector<Twist<d>> s_before;            // of walls, repaired
  std::vector<Vec<d>> x_mid;                 // where a motion is judged
  std::vector<double> r, repaired;           // residual, repair impulse
  std::vector<Wrench<d>> on_walls, dragged;  // impulses of effects and of sticking
  Eigen::VectorXd known, answer;             // impulses on the motions besides the pressure's, and what they did
};

template <class Archive, class T>
void raw(Archive& archive, std::vector<T>& values) {
  std::size_t count = values.size();
  archive(count);
  values.resize(count);
  archive(cereal::binary_data(values.data(), count * sizeof(T)));
}

template <class Archive, int d>
void archive_present(Archive& archive, Present<d>& s) {
  archive(s.time, s.dt, s.acceleration_dt, cereal::binary_data(&s.ledger, sizeof(Ledger)));
  raw(archive, s.nodes.x), raw(archive, s.nodes.v), raw(archive, s.nodes.p), raw(archive, s.nodes.q);
  raw(archive, s.nodes.tie), raw(archive, s.nodes.surface), raw(archive, s.nodes.separates);
  raw(archive, s.nodes.spray), raw(archive, s.nodes.volume), raw(archive, s.h);
  raw(archive, s.mesh.cells), raw(archive, s.mesh.boundary);
  raw(archive, s.poses), raw(archive, s.velocity), raw(archive, s.wetted);
}

template <int d>
void share_volumes(Nodes<d>& nodes, const Mesh<d>& mesh, const NodeCells<d>& around) {
  std::vector<double> share(mesh.cells.size());
  in_parallel(share.size(), [&](std::size_t c) { share[c] = volume<d>(corners(nodes.x, mesh.cells[c])) / (d + 1); });
  in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.spray[i]) return;
    nodes.volume[i] = 0;
    for (const auto [c, k] : around.around(i)) nodes.volume[i] += share[c];
  });
}

// Shorter edges are merged or lie across a film, and limit no time step.
constexpr double merged_below = 0.45;
template <int d>
double squared_length(const Present<d>& at, int i, int j) {
  const double short_edge = merged_below * std::min(at.h[i], at.h[j]);
  return std::max((at.nodes.x[i] - at.nodes.x[j]).squaredNorm(), short_edge * short_edge);
}

// Measured on a standing wave: with fewer its amplitude drifts by more than 0.5 % a period.
constexpr int corrections = 3;
constexpr int repairs = 2;
// Tolerances of iterative solves: the pressure solve takes out what the repair leaves of the flux, the corrections what
// the pressure solve leaves; each of them leaves a tenth of the residual anyhow.
constexpr double closely = 1e-4, roughly = 1e-2;

}  // namespace

template <int d>
struct Fluid<d>::State {
  FluidSpec<d> spec;
  std::vector<std::unique_ptr<Term<d>>> terms;
  std::vector<Wall<d>> walls;
  PhaseTimer timer{{"mesh", "assemble", "momentum", "pressure", "move"}};

  Present<d> now;         // committed
  Present<d> work;        // now, remeshed
  bool prepared = false;  // work belongs to now

  double kick = 0, dt = 0;
  PressureEquation<d> equation;
  std::optional<WallMotion<d>> wall_motion;
  typename WallMotion<d>::Moved moved;
  Trial<d> trial;
  std::vector<Vec<d>> v_after;
  std::vector<Twist<d>> s_after;
  std::vector<double> found_by_corrections;  // nodes' next q
  std::vector<double> phi;                   // physical impulse
  std::vector<double> interface;             // physical impulse on the pieces of walls with a Laplacian
  std::vector<double> carried_p;             // pressure at the nodes before the step
  std::vector<WallLoad<d>> loads;
  std::vector<Twist<d>> imbalance;
  double power_on_walls = 0;
  double energy_carried = 0, energy_before = 0, energy_repaired = 0;  // before remeshing, after, repaired

  WallsAt<d> walls_at(const std::vector<Isometry<d>>& poses) const { return {walls, poses}; }

  std::vector<Vec<d>> centres(const std::vector<Isometry<d>>& poses) const {
    std::vector<Vec<d>> c;
    for (const auto& p : poses) c.push_back(p.translation());
    return c;
  }

  std::vector<Isometry<d>> moved_poses(std::span<const Twist<d>> s, double by) const {
    std::vector<Isometry<d>> out;
    for (std::size_t w = 0; w < walls.size(); ++w) out.push_back(fluid::moved<d>(work.poses[w], s[w], by));
    return out;
  }

  StepView<d> view() const {
    return {work.nodes,        work.mesh,  spec.density, kick, equation.lumped_volume(),
            equation.around(), spec.walls, work.poses};
  }

  // Nodes that stick hand what the pressure and the forces left along their wall over to it. Part of the
  // corrections: bodies that respond get the new part of it. Returns the impulses on all walls.
  void stick(std::vector<Wrench<d>>& impulses) {
    std::vector<Wrench<d>> now_on_walls;
    wall_motion->drag(v_after, moved.u, spec.density, equation.lumped_volume(), now_on_walls);
    for (std::size_t w = 0; w < walls.size(); ++w) impulses[w] = now_on_walls[w] - impulses[w];
    push(equation.on_motions(impulses));
    impulses = std::move(now_on_walls);
  }

  // A further impulse on the motions: water and bodies answer.
  void push(const Eigen::VectorXd& impulse) {
    if (impulse.isZero(0)) return;
    std::vector<double> none(phi.size(), 0.0);
    trial.known += impulse;
    trial.answer += equation.respond(none, s_after, impulse);
    for (std::size_t i = 0; i < phi.size(); ++i) phi[i] += none[i];
  }

  // Solves for impulses and lets the motions answer to them.
  bool solve_with_bodies(std::vector<double>& r, std::vector<Twist<d>>& s, double tolerance) {
    if (!equation.solve(r, tolerance)) return false;
    answer_to(r, s);
    return true;
  }
  void answer_to(std::vector<double>& impulses, std::vector<Twist<d>>& s) {
    if (equation.motions() > 0)
      trial.answer += equation.respond(impulses, s, Eigen::VectorXd::Zero(equation.motions()));
  }

  double kinetic_energy(std::span<const Vec<d>> v) const {
    double e = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      e += (work.nodes.spray[i] ? work.nodes.volume[i] : equation.lumped_volume()[i]) * v[i].squaredNorm();
    return 0.5 * spec.density * e;
  }

  // |grad| of all effects' potential energy per mass; effects that have one are uniform fields.
  double gravity() const {
    Vec<d> g = Vec<d>::Zero();
    for (const auto& term : terms)
      for (int k = 0; k < d; ++k) g[k] += term->potential(Vec<d>::Unit(k)) - term->potential(Vec<d>::Zero());
    return g.norm();
  }

  void size_nodes() {
    const SizeField<d> field(spec.size, walls_at(work.poses), work.wetted, work.nodes.x, work.mesh);
    work.h.resize(work.nodes.size());
    in_parallel(work.h.size(), [&](std::size_t i) { work.h[i] = field(work.nodes.x[i]); });
  }

  // A node that leaves the mesh carries its share of volume; one that comes back brings it.
  void book_spray(const std::vector<char>& was_spray) {
    for (std::size_t i = 0; i < was_spray.size(); ++i)
      work.ledger.spray += (work.nodes.spray[i] - was_spray[i]) * work.nodes.volume[i];
  }

  void prepare() {
    const auto scope = timer.scope(remesh);
    work = now;
    energy_carried = 0;
    for (std::size_t i = 0; i < now.nodes.size(); ++i)
      energy_carried += 0.5 * spec.density * now.nodes.volume[i] * now.nodes.v[i].squaredNorm();
    size_nodes();
    wet<d>(work.nodes, work.h, work.mesh, walls_at(work.poses), work.velocity);
    if (now.dt > 0) adapt(work.nodes, work.h, work.mesh, walls_at(work.poses));
    if constexpr (d == 3) {
      // Along a space-filling curve: neighbours are near in memory, and in the same block of the smoother.
      const auto order = spatial_order<d>(work.nodes.x);
      keep({order.begin(), order.end()}, work.nodes, work.h, work.mesh.boundary);
    }
    const double before = enclosed_volume(work.mesh.boundary, work.nodes.x);
    const std::vector<char> was_spray = work.nodes.spray;
    work.mesh = recognise<d>(work.nodes, work.h, work.mesh.boundary, walls_at(work.poses));
    book_spray(was_spray);
    separate<d>(work.nodes, work.h, work.mesh, walls_at(work.poses), work.velocity, gravity());
    land(work.nodes, work.mesh);
    carried_p = work.nodes.p;
    const double after = enclosed_volume(work.mesh.boundary, work.nodes.x);
    const double adapted = before - now.ledger.volume;
    (after > before ? work.ledger.remesh_created : work.ledger.remesh_deleted) += after - before;
    (adapted > 0 ? work.ledger.remesh_created : work.ledger.remesh_deleted) += adapted;
    work.ledger.volume = after;
    work.wetted = wetted_measures(work.mesh, work.nodes.x, walls.size());
    prepared = true;
  }

  // The first guess of impulses is the pressure of the last step, with what the corrections found and without.
  std::vector<double> carried_impulse(bool corrected) const {
    std::vector<double> carried(equation.size());
    for (std::size_t i = 0; i < carried_p.size(); ++i)
      if (const int k = equation.unknown()[i]; k >= 0)
        carried[k] = kick * (corrected ? carried_p[i] : carried_p[i] - work.nodes.q[i]);
    return carried;
  }

  Status solve(std::span<const Twist<d>> given, std::span<const double> previous, const MotionDrive& drive);
  Status repair();
  Status predict();
  Status press(std::span<const Twist<d>> given, std::span<const double> previous);
  Status correct(std::span<const double> previous);
  void weigh();
  void lag(std::vector<double>& residual, std::span<const double> previous, std::span<const double> present) const;
  void middle(std::span<const Vec<d>> u, double by) {
    for (std::size_t i = 0; i < u.size(); ++i) trial.x_mid[i] = work.nodes.x[i] + by * u[i];
  }
  bool finite() const;
  bool orderly() const;
};

template <int d>
Fluid<d>::Fluid(FluidSpec<d> spec, std::vector<std::unique_ptr<Term<d>>> terms) : s_(std::make_unique<State>()) {
  s_->spec = std::move(spec);
  s_->terms = std::move(terms);
  for (const auto& term : s_->terms) s_->timer.add(term->name());
  Present<d>& now = s_->now;
  for (const auto& w : s_->spec.walls) {
    s_->walls.emplace_back(w);
    now.poses.push_back(w.pose);
    now.velocity.push_back(w.velocity);
  }
  auto liquid = fill<d>(s_->spec, s_->walls_at(now.poses));
  now.nodes = std::move(liquid.nodes);
  now.mesh = std::move(liquid.mesh);
  now.h = std::move(liquid.h);
  NodeCells<d> around;
  around.build(now.mesh.cells, now.nodes.size());
  share_volumes(now.nodes, now.mesh, around);
  now.wetted = wetted_measures(now.mesh, now.nodes.x, s_->walls.size());
  now.ledger.volume = now.ledger.volume_initial = enclosed_volume(now.mesh.boundary, now.nodes.x);
}

template <int d>
Fluid<d>::~Fluid() = default;

template <int d>
double Fluid<d>::time() const {
  return s_->now.time;
}

template <int d>
double Fluid<d>::stable_dt() const {
  const auto& now = s_->now;
  constexpr double never = std::numeric_limits<double>::infinity();
  const double squared = least_in_parallel(now.mesh.cells.size(), [&](std::size_t c) {
    const auto& cell = now.mesh.cells[c];
    // Sheets may deform by more than this; verdict() refuses steps in which they turn over.
    if (std::all_of(cell.begin(), cell.end(), [&](int n) { return now.nodes.surface[n]; })) return never;
    double least = never;
    for (int i = 0; i < d; ++i)
      for (int j = i + 1; j <= d; ++j) {
        const double rate = (now.nodes.v[cell[i]] - now.nodes.v[cell[j]]).squaredNorm();
        const double length = squared_length(now, cell[i], cell[j]);
        if (length < least * rate) least = length / rate;
      }
    return least;
  });
  double dt = std::min(s_->spec.step.dt_max, s_->spec.step.cfl * std::sqrt(squared));
  dt = std::min(dt, now.acceleration_dt);
  for (const auto& t : s_->terms) dt = std::min(dt, t->stable_dt());
  return dt;
}

template <int d>
Status Fluid<d>::begin(double kick, double dt, const WallResponse<d>& response) {
  State& s = *s_;
  s.kick = kick;
  s.dt = dt;
  if (!s.prepared) s.prepare();
  {
    const auto scope = s.timer.scope(assemble);
    if (!s.equation.build(s.work.nodes, s.work.mesh, s.spec.density, s.centres(s.work.poses), response))
      return {"the pressure matrix could not be factored"};
    s.wall_motion.emplace(s.work.nodes, s.work.mesh, s.walls_at(s.work.poses));
    s.interface = s.equation.laplacian().means(s.carried_impulse(true));
  }
  for (std::size_t t = 0; t < s.terms.size(); ++t) {
    const auto scope = s.timer.scope(effects + t);
    if (auto status = s.terms[t]->begin(s.view()); !status.ok()) return status;
  }
  return {};
}

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
    if (!solve_with_bodies(r, s_before, closely)) return {"the pressure solve failed"};
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
    for (std::size_t i = 0; i < count; ++i) trial.x_mid[i] = 0.5 * (work.nodes.x[i] + moved.x[i]);
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
  const double margin = least_in_parallel(work.mesh.cells.size(), [&](std::size_t c) {
    double least = std::numeric_limits<double>::infinity();
    const auto& cell = work.mesh.cells[c];
    if (std::none_of(cell.begin(), cell.end(), [&](int n) { return equation.unknown()[n] >= 0; })) return least;
    for (int i = 0; i < d; ++i)
      for (int j = i + 1; j <= d; ++j) {
        const double change = dt / most * (moved.u[cell[i]] - moved.u[cell[j]]).norm();
        least = std::min(least, squared_length(work, cell[i], cell[j]) - change * change);
      }
    return least;
  });
  return margin >= 0;
}

template <int d>
Status Fluid<d>::solve(std::span<const Twist<d>> walls, std::span<const double> previous, const MotionDrive& drive) {
  return s_->solve(walls, previous, drive);
}

template <int d>
Status Fluid<d>::verdict() const {
  return s_->orderly() ? Status{} : Status{"an element turns over within the step"};
}

template <int d>
void Fluid<d>::commit(std::span<const Isometry<d>> poses) {
  State& s = *s_;
  const auto scope = s.timer.scope(motion);
  Ledger& ledger = s.work.ledger;
  const double before = ledger.volume;
  s.wall_motion->move(s.v_after, poses, s.dt, s.moved);
  double acceleration_dt = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.work.nodes.size(); ++i) {
    Nodes<d>& nodes = s.work.nodes;
    const Vec<d> v_next = s.moved.u[i];
    if (!nodes.spray[i]) {
      const double a = (v_next - nodes.v[i]).norm() / s.kick;
      acceleration_dt = std::min(acceleration_dt, 0.5 * std::sqrt(s.work.h[i] / (a + 1e-300)));
    }
    nodes.x[i] = s.moved.x[i];
    nodes.v[i] = v_next;
    nodes.tie[i] = s.moved.tie[i];
    nodes.q[i] = s.found_by_corrections[i];
  }
  share_volumes(s.work.nodes, s.work.mesh, s.equation.around());
  ventilate<d>(s.work.nodes, s.work.mesh, s.spec.density, s.s_after, poses);
  ledger.volume = enclosed_volume(s.work.mesh.boundary, s.work.nodes.x);
  ledger.time_integration += ledger.volume - before;
  ledger.energy_repair += s.energy_repaired - s.energy_before;
  ledger.energy_remesh += s.energy_before - s.energy_carried;
  ledger.work_on_walls = s.now.ledger.work_on_walls + s.kick * s.power_on_walls;
  s.work.acceleration_dt = acceleration_dt;
  s.work.time += s.dt;
  s.work.dt = s.dt;
  s.work.poses.assign(poses.begin(), poses.end());
  s.work.velocity = s.s_after;
  s.now = std::move(s.work);
  s.prepared = false;
}

template <int d>
std::span<const WallLoad<d>> Fluid<d>::loads() const {
  return s_->loads;
}
template <int d>
std::span<const Twist<d>> Fluid<d>::wall_velocities() const {
  return s_->s_after;
}
template <int d>
Eigen::MatrixXd Fluid<d>::added_mass(std::span<const std::size_t> walls) const {
  if (!s_->prepared) throw std::logic_error("fluid: the added mass is known from begin to commit");
  return s_->equation.added_mass_of(walls);
}
template <int d>
Eigen::MatrixXd Fluid<d>::interface_slope(std::span<const std::size_t> walls) const {
  if (!s_->prepared) throw std::logic_error("fluid: the slope is known from begin to commit");
  return s_->equation.interface_slope(walls);
}
template <int d>
std::span<const Twist<d>> Fluid<d>::imbalance() const {
  return s_->imbalance;
}
template <int d>
std::span<const double> Fluid<d>::interface_impulse() const {
  return s_->interface;
}
template <int d>
std::span<const InterfacePiece> Fluid<d>::interface_pieces() const {
  return s_->equation.laplacian().pieces();
}
template <int d>
const FluidSpec<d>& Fluid<d>::spec() const {
  return s_->spec;
}
template <int d>
const Nodes<d>& Fluid<d>::nodes() const {
  return s_->prepared ? s_->work.nodes : s_->now.nodes;
}
template <int d>
const Mesh<d>& Fluid<d>::mesh() const {
  return s_->prepared ? s_->work.mesh : s_->now.mesh;
}
template <int d>
const Ledger& Fluid<d>::ledger() const {
  return s_->prepared ? s_->work.ledger : s_->now.ledger;
}
template <int d>
std::span<const Isometry<d>> Fluid<d>::wall_poses() const {
  return s_->prepared ? s_->work.poses : s_->now.poses;
}
template <int d>
Vec<d> Fluid<d>::velocity_n(std::size_t node) const {
  const Vec<d>& before = nodes().v[node];
  return s_->prepared && node < s_->v_after.size() ? Vec<d>(0.5 * (before + s_->moved.u[node])) : before;
}

template <int d>
std::optional<double> Fluid<d>::pressure_at(const Vec<d>& point) const {
  constexpr double outside = 1e-9;  // barycentric coordinate below which a point is outside: roundoff
  for (const auto& cell : mesh().cells) {
    const auto at = corners(nodes().x, cell);
    const auto g = volume_gradients<d>(at);
    const double e = (at(d) - at(0)).dot(g.col(d));
    double p = 0;
    bool inside = true;
    for (int k = 0; k <= d && inside; ++k) {
      const double share = (point - at(k)).dot(g.col(k)) / e + 1.0;
      inside = share >= -outside;
      p += share * nodes().p[cell[k]];
    }
    if (inside) return p;
  }
  return std::nullopt;
}

template <int d>
const std::vector<std::unique_ptr<Term<d>>>& Fluid<d>::terms() const {
  return s_->terms;
}
template <int d>
std::vector<std::pair<std::string, double>> Fluid<d>::phase_seconds() const {
  return s_->timer.seconds();
}

template <int d>
void Fluid<d>::save(std::ostream& out) const {
  cereal::BinaryOutputArchive archive(out);
  archive_present(archive, s_->now);
}
template <int d>
void Fluid<d>::load(std::istream& in) {
  cereal::BinaryInputArchive archive(in);
  archive_present(archive, s_->now);
  s_->prepared = false;
}

template class Fluid<2>;
template class Fluid<3>;

}  // namespace splashdown::fluid
