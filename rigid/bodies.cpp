#include "rigid/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>

#include "rigid/bullet_world.hpp"
#include "rigid/embedding.hpp"
#include "rigid/free_body.hpp"
#include "rigid/message.hpp"
#include "rigid/motions.hpp"

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
  std::optional<Contacts<d>> contacts;
  BulletWorld bullet;
  std::vector<std::unique_ptr<FreeBody>> movers;  // empty for bodies that forces do not move
  std::vector<Condition<d>> tied, near;           // by joints, and by contacts that may close, of the begun step
  Motions motions;
  Eigen::VectorXd apart;  // velocities that only drift: how hulls that overlap part
  double time = 0, kick = 0, dt = 0;
  Phase phase = Phase::committed;

  void expect(bool fine, const char* rule) const {
    if (!fine) throw std::logic_error(message("bodies at t = ", time, " s: ", rule));
  }

  void expect_all(const Eigen::VectorXd& values) const {
    if (values.size() != m * size())
      throw std::invalid_argument(
          message("bodies: ", values.size(), " values for the ", m * size(), " coordinates of ", size(), " bodies"));
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

  static constexpr int m = freedoms<d>;
  Eigen::Index size() const { return static_cast<Eigen::Index>(specs.size()); }

  std::vector<Condition<d>> joints() {
    std::vector<Condition<d>> all;
    const auto lift = embedding<d>();
    for (const auto& c : bullet.conditions(dt))
      all.push_back({c.body, c.other, lift.transpose() * c.first, lift.transpose() * c.second, c.rate});
    return all;
  }

  /// Joints, then what is held: freedoms of free bodies, and others altogether.
  std::vector<Condition<d>> equalities() {
    std::vector<Condition<d>> all = tied;
    for (std::size_t i = 0; i < specs.size(); ++i) {
      const Twist<d>& velocity = movers[i] ? states[i].velocity : trials[i].velocity;
      for (int k = 0; k < m; ++k)
        if (!movers[i] || !specs[i].free[static_cast<std::size_t>(k)])
          all.push_back({i, {}, Wrench<d>::Unit(k), Wrench<d>::Zero(), velocity[k]});
    }
    return all;
  }

  void fill(const std::vector<Condition<d>>& conditions, Eigen::MatrixXd& rows, Eigen::VectorXd& rates) const {
    rows.setZero(static_cast<Eigen::Index>(conditions.size()), m * size());
    rates.resize(rows.rows());
    for (Eigen::Index r = 0; r < rows.rows(); ++r) {
      const auto& c = conditions[static_cast<std::size_t>(r)];
      rows.template block<1, m>(r, m * static_cast<Eigen::Index>(c.body)) += c.first.transpose();
      if (c.other) rows.template block<1, m>(r, m * static_cast<Eigen::Index>(*c.other)) += c.second.transpose();
      rates[r] = c.rate;
    }
  }

  void find_motions() {
    for (Eigen::Index i = 0; i < size(); ++i) place(i, states[static_cast<std::size_t>(i)]);
    tied = joints();
    if (contacts) near = contacts->within_reach(states, dt);
    solve_conditions();
    if (tied.empty()) return;
    // Joints are met at x_{n+1}, but for what the fluid's load adds to the curvature of the way there (SHAKE, Ryckaert,
    // Ciccotti, Berendsen 1977): what a trial step without the load still violates goes into the rates.
    constexpr int trials_enough = 3;  // quadratic: (w dt)^2, ^4, ^8
    for (int k = 0; k < trials_enough; ++k) {
      drift(motions.velocity(Eigen::VectorXd::Zero(m * size())));
      for (Eigen::Index i = 0; i < size(); ++i) place(i, trials[static_cast<std::size_t>(i)]);
      const auto at_end = joints();
      for (std::size_t c = 0; c < tied.size(); ++c) tied[c].rate += at_end[c].rate;
      solve_conditions();
    }
  }

  void place(Eigen::Index i, const BodyState<d>& state) {
    bullet.place(static_cast<std::size_t>(i), lifted<d>(state.pose), embedding<d>() * state.velocity);
  }

  void solve_conditions() {
    typename Motions::Problem p;
    p.before.setZero(m * size());
    p.unit.setOnes(m * size());
    p.inertia.setZero(m * size(), m * size());
    p.impulse.setZero(m * size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      const auto b = static_cast<std::size_t>(i);
      p.unit.segment(m * i + d, rotations<d>).setConstant(reach(specs[b]));
      p.before.segment<m>(m * i) = states[b].velocity;
      if (!movers[b]) continue;
      p.inertia.block<m, m>(m * i, m * i) = embedding<d>().transpose() * movers[b]->inertia() * embedding<d>();
      p.impulse.segment<m>(m * i) = embedding<d>().transpose() * movers[b]->impulse();
    }
    fill(equalities(), p.equalities, p.equal);
    fill(near, p.contacts, p.least);
    constexpr double flush = 1e-10;  // of the bodies' lengths: what positions do not resolve
    p.resolution = flush * p.unit.maxCoeff() / dt;
    part_overlaps(p);
    p.least = p.least.cwiseMin(0);
    motions = Motions(p);
  }

  /// Hulls that overlap move apart as they drift, the heavy ones least, without speed: it would be energy from nowhere.
  void part_overlaps(typename Motions::Problem p) {
    apart.setZero(m * size());
    if ((p.least.array() <= p.resolution).all()) return;
    p.before.setZero();
    p.equal.setZero();
    p.impulse.setZero();
    Motions parting(p);
    if (const auto found = settled(parting, p.impulse)) apart = *found;
  }

  /// Faster than at t_n, bodies reach more than was looked at.
  Status passes_through() const {
    if (!contacts) return {};
    std::vector<BodyState<d>> reaching = states;
    bool faster = false;
    for (std::size_t i = 0; i < specs.size(); ++i) {
      faster = faster || trials[i].velocity.norm() > states[i].velocity.norm();
      reaching[i].velocity = trials[i].velocity;
    }
    if (!faster) return {};
    for (const Condition<d>& c : contacts->within_reach(reaching, dt)) {
      if (std::ranges::any_of(near, [&](const Condition<d>& n) { return n.body == c.body && n.first == c.first; }))
        continue;
      double rate = c.first.dot(trials[c.body].velocity), speed = trials[c.body].velocity.norm();
      if (c.other) rate += c.second.dot(trials[*c.other].velocity), speed += trials[*c.other].velocity.norm();
      constexpr double crossed = 1e-6;  // of the speed: roundoff
      if (rate < std::min(c.rate, 0.0) - crossed * speed * (1 + reach(specs[c.body])))
        return {message("a body passes through what it touches within the step: \"", specs[c.body].name, "\"")};
    }
    return {};
  }

  /// Velocities under these impulses, contacts opening and closing as they ask for; none if that does not end.
  static std::optional<Eigen::VectorXd> settled(Motions& motions, const Eigen::VectorXd& impulses) {
    constexpr int most = 100;  // more changes than contacts in a scene
    Eigen::VectorXd velocity = motions.velocity(impulses);
    for (int i = 0; motions.update_contacts(velocity, impulses); ++i) {
      if (i == most) return {};
      velocity = motions.velocity(impulses);
    }
    return velocity;
  }

  Eigen::VectorXd stacked(std::span<const Wrench<d>> each) const {
    if (each.size() != specs.size())
      throw std::invalid_argument(message("bodies: values for ", each.size(), " of ", specs.size(), " bodies"));
    Eigen::VectorXd all(m * size());
    for (Eigen::Index i = 0; i < size(); ++i) all.segment<m>(m * i) = each[static_cast<std::size_t>(i)];
    return all;
  }

  void drift(const Eigen::VectorXd& velocities) {
    for (std::size_t i = 0; i < specs.size(); ++i) {
      if (!movers[i]) continue;
      const Twist<d> s = velocities.segment<m>(m * static_cast<Eigen::Index>(i));
      const Twist<d> moves = s + apart.segment<m>(m * static_cast<Eigen::Index>(i));
      bullet.place(i, lifted<d>(states[i].pose), embedding<d>() * (s.allFinite() ? moves : Twist<d>::Zero().eval()));
    }
    bullet.drift(dt);
    for (std::size_t i = 0; i < specs.size(); ++i) {
      if (!movers[i]) continue;
      trials[i] = {lowered<d>(bullet.pose(i)), velocities.segment<m>(m * static_cast<Eigen::Index>(i))};
      if (!trials[i].velocity.allFinite())
        trials[i].pose.matrix().template topRows<d>().setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    phase = Phase::solved;
  }
};

template <int d>
Bodies<d>::Bodies(std::vector<BodySpec<d>> specs, std::vector<std::unique_ptr<Force<d>>> forces,
                  std::vector<JointSpec> joints, std::optional<ContactSpec<d>> contacts)
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
    w.bullet.add(spec.motion == Motion::free);
    w.bullet.place(w.states.size() - 1, lifted<d>(pose), Twist<3>::Zero());
    if (spec.motion != Motion::free) continue;

    FreeBody::Freedom free{};
    for (int k = 0; k < freedoms<d>; ++k) {
      int in_space = 0;
      embedding<d>().col(k).maxCoeff(&in_space);
      free[static_cast<std::size_t>(in_space)] = spec.free[static_cast<std::size_t>(k)];
    }
    w.movers.back() =
        std::make_unique<FreeBody>(spec.mass, lifted_inertia<d>(spec.inertia), free, lifted_state(w.states.back()));
  }
  for (const JointSpec& joint : joints) {
    check(joint, size());
    w.bullet.add(joint);
    if (contacts && joint.other) contacts->apart.insert(std::minmax(joint.body, *joint.other));
  }
  if (contacts) w.contacts.emplace(std::move(*contacts), w.specs);
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
std::span<const BodyState<d>> Bodies<d>::states() const {
  return world_->states;
}
template <int d>
std::span<const BodyState<d>> Bodies<d>::trials() const {
  return world_->trials;
}
template <int d>
double Bodies<d>::time() const {
  return world_->time;
}

template <int d>
void Bodies<d>::begin(double kick, double dt) {
  World& w = *world_;
  if (!(kick > 0 && dt > 0 && std::isfinite(kick) && std::isfinite(dt)))
    throw std::invalid_argument(message("bodies: kick = ", kick, " s and dt = ", dt, " s must be positive"));
  w.kick = kick;
  w.dt = dt;
  for (std::size_t i = 0; i < size(); ++i) {
    if (w.movers[i]) w.movers[i]->begin(lifted_state(w.states[i]), embedding<d>() * (kick * w.known_force(i)), dt);
    if (w.specs[i].motion == Motion::prescribed) w.trials[i] = w.prescribed(i);
  }
  w.find_motions();
  w.phase = Phase::begun;
}

template <int d>
Mobility<d> Bodies<d>::mobility() const {
  const World& w = *world_;
  w.expect(w.phase != Phase::committed, "mobility needs begin first");
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(freedoms<d> * w.size());
  const Eigen::VectorXd s = w.motions.velocity(none);
  Mobility<d> all{{}, w.motions.modes(), w.motions.inertia(), w.motions.directions(), w.motions.unspent(s, none)};
  for (Eigen::Index i = 0; i < w.size(); ++i) all.velocities.push_back(s.segment<freedoms<d>>(freedoms<d> * i));
  return all;
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::solve(std::span<const Wrench<d>> loads) {
  return solve(Eigen::VectorXd(world_->kick * world_->stacked(loads)));
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::solve(const Eigen::VectorXd& impulses) {
  World& w = *world_;
  w.expect(w.phase != Phase::committed, "solve needs begin first");
  w.expect_all(impulses);
  const auto velocity = w.settled(w.motions, impulses);
  w.drift(velocity ? *velocity : Eigen::VectorXd::Constant(impulses.size(), std::numeric_limits<double>::quiet_NaN()));
  return w.trials;
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::adopt(const Eigen::VectorXd& velocities) {
  World& w = *world_;
  w.expect(w.phase != Phase::committed, "adopt needs begin first");
  w.expect_all(velocities);
  w.drift(velocities);
  return w.trials;
}

template <int d>
bool Bodies<d>::update_contacts(const Eigen::VectorXd& impulses) {
  World& w = *world_;
  w.expect(w.phase == Phase::solved, "update_contacts needs a trial first");
  w.expect_all(impulses);
  Eigen::VectorXd velocities(freedoms<d> * w.size());
  for (Eigen::Index i = 0; i < w.size(); ++i)
    velocities.segment<freedoms<d>>(freedoms<d> * i) = w.trials[static_cast<std::size_t>(i)].velocity;
  return w.motions.update_contacts(velocities, impulses);
}

template <int d>
Status Bodies<d>::acceptable() const {
  const World& w = *world_;
  w.expect(w.phase == Phase::solved, "acceptable needs a trial first");
  constexpr double most_turn = 1;  // [rad] beyond which the way there is not that of a step
  for (std::size_t i = 0; i < size(); ++i) {
    const double turn = w.dt * w.trials[i].velocity.template tail<rotations<d>>().norm();
    if (w.movers[i] && turn > most_turn)
      return {message("a body turns too far within the step: \"", w.specs[i].name, "\" by ", turn, " rad")};
  }
  return w.passes_through();
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
    throw std::runtime_error(message("holds ", count, " bodies, the scene has ", size()));
  read(in, &w.time, 1);
  for (std::size_t i = 0; i < size(); ++i) {
    read(in, w.states[i].pose.data(), w.states[i].pose.matrix().size());
    read(in, w.states[i].velocity.data(), freedoms<d>);
    if (w.movers[i]) read(in, w.movers[i]->momentum.data(), 3);
  }
  if (!in) throw std::runtime_error("ends in the middle of the bodies");
  constexpr double roundoff = 1e-6;  // of rotations, far above what they gather
  bool good = std::isfinite(w.time);
  for (const auto& state : w.states)
    good = good && state.pose.matrix().allFinite() && state.pose.linear().isUnitary(roundoff) &&
           state.velocity.allFinite();
  for (const auto& mover : w.movers) good = good && (!mover || mover->momentum.allFinite());
  if (!good) throw std::runtime_error("the bodies' state is damaged");
  w.trials = w.states;
  w.phase = Phase::committed;
}

template class Bodies<2>;
template class Bodies<3>;

}  // namespace splashdown::rigid
