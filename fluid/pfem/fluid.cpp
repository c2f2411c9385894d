#include "fluid/pfem/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/pfem/collision_bound.hpp"
#include "fluid/pfem/contact/ventilation.hpp"
#include "fluid/pfem/fluid_state.hpp"
#include "fluid/pfem/initial/initial.hpp"
#include "fluid/pfem/mesh/conservation/volume_correction.hpp"
#include "fluid/pfem/mesh/parts.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/wave_bound.hpp"

namespace splashdown::fluid {
namespace {

// Where films turn over, cells count as less than nothing, nodes as nothing.
template <int d>
void carry(Nodes<d>& nodes, std::span<const double> volumes) {
  in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.spray[i]) return;
    const double now = std::max(0.0, volumes[i]);
    nodes.owed[i] += nodes.volume[i] - now;
    nodes.volume[i] = now;
  });
}

// Where p = 0 is held, no pressure keeps a node's volume. What it gains while it runs ahead of its neighbours is their
// water, and comes with their momentum. A node that has lost all of its volume has no momentum of its own left: it goes with its
// neighbours. `before`: nodal volumes, before the motion.
template <int d>
void entrain(Nodes<d>& nodes, const Mesh<d>& mesh, const NodeCells<d>& around, std::span<const int> unknown,
             std::span<const double> before) {
  struct Change {
    std::size_t node;
    Vec<d> v;
  };
  std::vector<Change> changes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double gained = nodes.volume[i] - before[i];
    const bool is_empty = nodes.volume[i] == 0;
    if (nodes.spray[i] || nodes.tie[i].sharp() || !(is_empty || (unknown[i] < 0 && gained > 0))) continue;
    VelocityMoments<d> water;  // around it
    for (const auto [c, k] : around.around(i)) {
      const double share = std::max(0.0, volume<d>(corners(nodes.x, mesh.cells[c])));
      for (int n : mesh.cells[c])
        if (n != static_cast<int>(i)) water += VelocityMoments<d>::of(is_empty ? nodes.volume[n] : share, nodes.v[n]);
    }
    if (!(water.volume > 0)) continue;
    const Vec<d> v = water.mean_velocity();
    changes.push_back({i, is_empty ? v : Vec<d>((before[i] * nodes.v[i] + gained * v) / nodes.volume[i])});
  }
  for (const Change& change : changes) nodes.v[change.node] = change.v;
}

}  // namespace

template <int d>
Fluid<d>::Fluid(FluidSpec<d> spec, std::vector<std::unique_ptr<Effect<d>>> effects) : s_(std::make_unique<State>()) {
  s_->spec = std::move(spec);
  s_->effects = std::move(effects);
  for (const auto& effect : s_->effects) s_->timer.add(effect->name());
  Present<d>& now = s_->now;
  for (const auto& w : s_->spec.walls) {
    s_->walls.emplace_back(w);
    now.poses.push_back(w.pose);
    now.velocity.push_back(w.velocity);
  }
  auto liquid = fill<d>(s_->spec, s_->walls_at(now.poses));
  now.nodes = std::move(liquid.nodes);
  now.mesh = std::move(liquid.mesh);
  now.nodes.volume = nodal_volumes(now.mesh, now.nodes.x);
  now.nodes.part = parts_of(now.mesh, now.nodes.size());
  now.chords.assign(s_->walls.size(), 0.0);
  now.displaced = displaced_volumes(now.mesh, now.nodes.x, s_->walls.size(), s_->mirror());
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
  if (is_waiting()) return s_->spec.step.dt_max;
  constexpr double never = std::numeric_limits<double>::infinity();
  const double squared = least_in_parallel(now.mesh.cells.size(), [&](std::size_t c) {
    const auto& cell = now.mesh.cells[c];
    // Sheets may deform by more than this; acceptable() refuses steps in which they turn over.
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
  dt = std::min({dt, now.acceleration_dt, wave_dt(now.nodes, now.mesh, s_->gravity()),
                 s_->spec.step.cfl * gap_time<d>(now.nodes, now.mesh, s_->walls_at(now.poses))});
  for (const auto& effect : s_->effects) dt = std::min(dt, effect->stable_dt());
  return collision_dt<d>(now.nodes, now.mesh, s_->walls_at(now.poses), now.velocity, s_->spec.step.cfl, dt);
}

template <int d>
Status Fluid<d>::begin(double kick, double dt, const InterfaceModel& structure) {
  State& s = *s_;
  s.kick = kick;
  s.dt = dt;
  s.solved = false;
  if (!s.prepared) s.prepare();
  {
    const auto scope = s.timer.scope(assemble);
    s.wall_motion.emplace(s.work.nodes, s.work.mesh, s.walls_at(s.work.poses),
                          walls_that_answer<d>(structure.modal, s.walls.size()));
    if (!s.equation.build(s.work.nodes, s.work.mesh, s.spec.density, s.centres(s.work.poses), structure,
                          s.wall_motion->held()))
      return {"the pressure matrix could not be factored"};
    s.wall_motion->meet_pressure(s.equation.unknown(), s.equation.lumped_volume());
  }
  for (std::size_t t = 0; t < s.effects.size(); ++t) {
    const auto scope = s.timer.scope(first_effect + t);
    if (auto status = s.effects[t]->begin(s.view()); !status.ok()) return status;
  }
  return s.add_pressure_terms();
}

// The matrix stands without them: their diagonal is its own reason to factor once more.
template <int d>
Status Fluid<d>::State::add_pressure_terms() {
  terms = {};
  for (std::size_t t = 0; t < effects.size(); ++t) {
    const auto scope = timer.scope(first_effect + t);
    effects[t]->pressure(view(), terms);
  }
  const auto scope = timer.scope(Phase::pressure);
  if (!equation.set_terms(terms.diagonal, terms.source)) return {"the pressure matrix could not be factored"};
  return {};
}

template <int d>
const StepResult<d>& Fluid<d>::solve(std::span<const Twist<d>> walls, std::span<const double> previous,
                                     const ClosedContacts& contacts) {
  s_->result = s_->solve(walls, previous, contacts);
  s_->solved = s_->result.status.ok();
  return s_->result;
}

template <int d>
const StepResult<d>& Fluid<d>::result() const {
  return s_->result;
}

template <int d>
Status Fluid<d>::acceptable() const {
  return s_->refusal().status;
}

template <int d>
bool Fluid<d>::release_fragment() {
  if (!s_->solved) return false;
  const int node = s_->refusal().node;
  if (node < 0) return false;
  s_->let_fragment_fly(node);
  s_->solved = false;
  return true;
}

// What terms of effects have made of the volume is no debt of the mesh.
template <int d>
double Fluid<d>::State::book_sources() {
  if (terms.source.empty() && terms.diagonal.empty()) return 0;
  std::vector<double> rate(static_cast<std::size_t>(equation.size()), 0.0);
  equation.add_sources(rate, trial.phi);
  double sum = 0;
  for (std::size_t i = 0; i < work.nodes.size(); ++i) {
    const int k = equation.unknown()[i];
    if (k < 0 || rate[k] == 0) continue;
    work.nodes.owed[i] += dt * rate[k];
    sum += dt * rate[k];
  }
  return sum;
}

template <int d>
void Fluid<d>::commit(std::span<const Isometry<d>> poses) {
  State& s = *s_;
  const auto scope = s.timer.scope(motion);
  for (const auto& effect : s.effects) effect->commit(s.view());
  s.work.ledger = s.result.ledger;
  s.work.nodes.p = s.result.carried;
  Ledger& ledger = s.work.ledger;
  const double before = ledger.volume;
  auto& moved = s.trial.moved;
  s.wall_motion->move(s.trial.v_after, poses, s.dt, moved);
  Nodes<d>& nodes = s.work.nodes;
  const double acceleration_dt = least_in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.spray[i]) return std::numeric_limits<double>::infinity();
    const double a = (moved.u[i] - nodes.v[i]).norm() / s.kick;
    return 0.5 * std::sqrt(nodes.h[i] / (a + 1e-300));
  });
  s.wall_motion->convect(moved.x, s.dt, moved.u);
  nodes.x = moved.x;
  nodes.v = moved.u;
  nodes.tie = moved.tie;
  const WallsAt<d> arrived{s.walls, poses};
  std::vector<double> moved_volumes;
  s.equation.around().sum(volume_shares(s.work.mesh, nodes.x), moved_volumes);
  carry<d>(nodes, moved_volumes);
  entrain(nodes, s.work.mesh, s.equation.around(), s.equation.unknown(), s.equation.lumped_volume());
  s.follow_hulls(poses);
  const double swept = s.water(), meant = s.book_sources();
  carry<d>(nodes, return_volume(nodes, s.work.mesh, arrived, s.free_water, moved_volumes, s.equation.lumped_volume()));
  s.free_water.give_back(s.trial.free_water, nodes.volume, nodes.v);
  average_wall_pressure<d>(nodes, s.work.mesh, arrived, s.result.wall_velocities, s.equation.unknown(),
                           s.trial.repaired, s.kick);
  ventilate<d>(nodes, s.work.mesh, arrived, s.result.wall_velocities, s.spec.density, s.gravity().norm());
  ledger.volume = s.water();
  ledger.time_integration += swept - before - meant;
  ledger.volume_of_effects += meant;
  ledger.returned += ledger.volume - swept;
  ledger.energy_repair += s.trial.energy_repaired - s.trial.energy_before;
  ledger.work_on_walls = s.now.ledger.work_on_walls + s.kick * s.result.power_on_walls;
  ledger.work_of_effects = s.now.ledger.work_of_effects;
  for (const double power : s.result.power_of_effects) ledger.work_of_effects += s.kick * power;
  s.work.acceleration_dt = acceleration_dt;
  s.work.time += s.dt;
  s.work.dt = s.dt;
  s.work.poses.assign(poses.begin(), poses.end());
  s.work.velocity = s.result.wall_velocities;
  s.now = std::move(s.work);
  s.prepared = s.solved = false;
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
std::vector<double> Fluid<d>::carried_interface_impulse() const {
  return s_->equation.laplacian().means(s_->carried_impulse());
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
  return s_->solved ? s_->result.ledger : s_->prepared ? s_->work.ledger : s_->now.ledger;
}
template <int d>
std::span<const double> Fluid<d>::pressure() const {
  return s_->solved ? s_->result.pressure : nodes().p;
}
template <int d>
std::span<const double> Fluid<d>::repair_pressure() const {
  return s_->solved ? std::span<const double>(s_->result.repair_pressure) : std::span<const double>();
}
template <int d>
std::span<const Isometry<d>> Fluid<d>::wall_poses() const {
  return s_->prepared ? s_->work.poses : s_->now.poses;
}
template <int d>
Vec<d> Fluid<d>::velocity_n(std::size_t node) const {
  const Vec<d>& before = nodes().v[node];
  return s_->solved ? s_->at_t_n(before, s_->result.velocity[node]) : before;
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
      p += share * pressure()[cell[k]];
    }
    if (inside) return p;
  }
  return std::nullopt;
}

template <int d>
const std::vector<std::unique_ptr<Effect<d>>>& Fluid<d>::effects() const {
  return s_->effects;
}
template <int d>
std::vector<std::pair<std::string, double>> Fluid<d>::phase_seconds() const {
  return s_->timer.seconds();
}

template class Fluid<2>;
template class Fluid<3>;

}  // namespace splashdown::fluid
