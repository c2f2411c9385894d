#include "rigid/bodies.hpp"

#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "rigid/embedding.hpp"
#include "rigid/free_body.hpp"
#include "rigid/message.hpp"

namespace splashdown::rigid {

namespace {

void write(std::ostream& out, const double* values, Eigen::Index count) {
  out.write(reinterpret_cast<const char*>(values), count * static_cast<std::streamsize>(sizeof(double)));
}

void read(std::istream& in, double* values, Eigen::Index count) {
  in.read(reinterpret_cast<char*>(values), count * static_cast<std::streamsize>(sizeof(double)));
}

template <int d>
BodyState<3> lifted_state(const BodyState<d>& state) {
  return {lifted<d>(state.pose), embedding<d>() * state.velocity};
}

enum class Phase { committed, begun, solved };

}  // namespace

template <int d>
struct Bodies<d>::World {
  std::vector<BodySpec<d>> specs;
  std::vector<std::unique_ptr<Force<d>>> forces;
  std::vector<BodyState<d>> states, trials;
  BulletWorld bullet;
  std::vector<std::unique_ptr<FreeBody>> movers;  // empty for bodies that forces do not move
  double time = 0, kick = 0, dt = 0;
  Phase phase = Phase::committed;

  void expect(bool fine, const char* rule) const {
    if (!fine) throw std::logic_error(message("bodies at t = ", time, " s: ", rule));
  }

  Wrench<d> known_force(std::size_t i) const {
    Wrench<d> sum = Wrench<d>::Zero();
    for (const auto& force : forces) sum += force->wrench(specs[i], states[i].pose, states[i].velocity, time);
    return sum;
  }

  /// A prescribed body's velocity is the finite difference that carries one pose into the next.
  BodyState<d> prescribed(std::size_t i) const {
    const Isometry<d> to = specs[i].path(time + dt);
    const Isometry<3> from_space = lifted<d>(states[i].pose), to_space = lifted<d>(to);
    Twist<3> displacement;
    displacement << to_space.translation() - from_space.translation(),
        rotation_log(to_space.linear() * from_space.linear().transpose());
    return {to, embedding<d>().transpose() * displacement / dt};
  }
};

template <int d>
Bodies<d>::Bodies(std::vector<BodySpec<d>> specs, std::vector<std::unique_ptr<Force<d>>> forces)
    : world_(std::make_unique<World>()) {
  World& w = *world_;
  w.specs = std::move(specs);
  w.forces = std::move(forces);
  for (const BodySpec<d>& spec : w.specs) {
    check(spec);
    const bool held_still = spec.motion == Motion::fixed;
    const Isometry<d> pose = spec.motion == Motion::prescribed ? spec.path(0) : spec.pose;
    w.states.push_back({pose, held_still ? Twist<d>::Zero().eval() : spec.velocity});
    w.movers.emplace_back();
    if (spec.motion != Motion::free) continue;

    FreeBody::Freedom free{};
    for (int k = 0; k < freedoms<d>; ++k) {
      int in_space = 0;
      embedding<d>().col(k).maxCoeff(&in_space);
      free[static_cast<std::size_t>(in_space)] = spec.free[static_cast<std::size_t>(k)];
    }
    w.movers.back() = std::make_unique<FreeBody>(w.bullet, spec.mass, lifted_inertia<d>(spec.inertia), free,
                                                 lifted_state(w.states.back()));
  }
  w.trials = w.states;
}

template <int d>
Bodies<d>::~Bodies() = default;
template <int d>
Bodies<d>::Bodies(Bodies&&) noexcept = default;
template <int d>
Bodies<d>& Bodies<d>::operator=(Bodies&&) noexcept = default;

template <int d>
std::size_t Bodies<d>::size() const {
  return world_->specs.size();
}
template <int d>
const BodySpec<d>& Bodies<d>::spec(std::size_t body) const {
  return world_->specs.at(body);
}
template <int d>
const BodyState<d>& Bodies<d>::state(std::size_t body) const {
  return world_->states.at(body);
}
template <int d>
double Bodies<d>::time() const {
  return world_->time;
}

template <int d>
Compliance<d> Bodies<d>::compliance(std::size_t body) const {
  const auto& mover = world_->movers.at(body);
  if (!mover) return Compliance<d>::Zero();
  const Compliance<3> c = world_->phase == Phase::committed
                              ? mover->compliance_at(lifted<d>(world_->states[body].pose))
                              : mover->compliance();
  return embedding<d>().transpose() * c * embedding<d>();
}

template <int d>
void Bodies<d>::begin(double kick, double dt) {
  World& w = *world_;
  if (!(kick > 0 && dt > 0 && std::isfinite(kick) && std::isfinite(dt)))
    throw std::invalid_argument(message("bodies: kick = ", kick, " s and dt = ", dt, " s must be positive"));
  w.kick = kick;
  w.dt = dt;
  for (std::size_t i = 0; i < size(); ++i) {
    if (w.movers[i])
      w.movers[i]->begin(lifted_state(w.states[i]), embedding<d>() * (kick * w.known_force(i)), dt);
    if (w.specs[i].motion == Motion::prescribed) w.trials[i] = w.prescribed(i);
  }
  w.phase = Phase::begun;
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::solve(std::span<const Wrench<d>> loads) {
  World& w = *world_;
  w.expect(w.phase != Phase::committed, "solve needs begin first");
  if (loads.size() != size())
    throw std::invalid_argument(message("bodies: ", loads.size(), " loads for ", size(), " bodies"));
  for (std::size_t i = 0; i < size(); ++i) {
    if (w.movers[i]) w.movers[i]->kick(w.bullet, embedding<d>() * (w.kick * loads[i]));
  }
  w.bullet.drift(w.dt);
  for (std::size_t i = 0; i < size(); ++i) {
    if (!w.movers[i]) continue;
    const BodyState<3> moved = w.movers[i]->drifted(w.bullet);
    w.trials[i] = {lowered<d>(moved.pose), embedding<d>().transpose() * moved.velocity};
  }
  w.phase = Phase::solved;
  return w.trials;
}

template <int d>
void Bodies<d>::commit() {
  World& w = *world_;
  w.expect(w.phase == Phase::solved, "commit needs solve first");
  for (std::size_t i = 0; i < size(); ++i) {
    if (w.movers[i]) w.movers[i]->commit(embedding<d>() * w.trials[i].velocity);
  }
  w.states = w.trials;
  w.time += w.dt;
  w.phase = Phase::committed;
}

template <int d>
void Bodies<d>::save(std::ostream& out) const {
  const World& w = *world_;
  const double count = static_cast<double>(size());
  write(out, &count, 1);
  write(out, &w.time, 1);
  for (std::size_t i = 0; i < size(); ++i) {
    write(out, w.states[i].pose.data(), w.states[i].pose.matrix().size());
    write(out, w.states[i].velocity.data(), freedoms<d>);
    if (w.movers[i]) write(out, w.movers[i]->momentum.data(), 3);
  }
}

template <int d>
void Bodies<d>::load(std::istream& in) {
  World& w = *world_;
  double count = 0;
  read(in, &count, 1);
  if (!in || count != static_cast<double>(size()))
    throw std::runtime_error(message("checkpoint holds ", count, " bodies, the scene has ", size()));
  read(in, &w.time, 1);
  for (std::size_t i = 0; i < size(); ++i) {
    read(in, w.states[i].pose.data(), w.states[i].pose.matrix().size());
    read(in, w.states[i].velocity.data(), freedoms<d>);
    if (w.movers[i]) read(in, w.movers[i]->momentum.data(), 3);
  }
  if (!in) throw std::runtime_error("checkpoint ends in the middle of the bodies");
  w.trials = w.states;
  w.phase = Phase::committed;
}

template class Bodies<2>;
template class Bodies<3>;

}  // namespace splashdown::rigid
