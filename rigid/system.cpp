#include "rigid/system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "rigid/constraints/condition_rows.hpp"
#include "rigid/embedding.hpp"
#include "rigid/message.hpp"
#include "rigid/spin.hpp"

namespace splashdown::rigid {

namespace {

/// The twist that takes one pose into the other within a unit of time.
template <int d>
Twist<d> displacement(const Isometry<d>& from, const Isometry<d>& to) {
  const Isometry<3> from_space = embedded<d>(from), to_space = embedded<d>(to);
  Twist<3> twist;
  twist << to_space.translation() - from_space.translation(),
      rotation_log(to_space.linear() * from_space.linear().transpose());
  return embedding<d>().transpose() * twist;
}

}  // namespace

template <int d>
void Bodies<d>::System::expect(bool fine, const char* rule) const {
  if (!fine) throw std::logic_error(message("bodies at t = ", time, " s: ", rule));
}

template <int d>
void Bodies<d>::System::expect_all(const Eigen::VectorXd& values) const {
  if (values.size() != freedoms<d> * size())
    throw std::invalid_argument(message("bodies: ", values.size(), " values for the ", freedoms<d> * size(),
                                        " coordinates of ", size(), " bodies"));
}

template <int d>
Eigen::VectorXd Bodies<d>::System::stacked(std::span<const Wrench<d>> each) const {
  if (each.size() != specs.size())
    throw std::invalid_argument(message("bodies: values for ", each.size(), " of ", specs.size(), " bodies"));
  Eigen::VectorXd all(freedoms<d> * size());
  for (Eigen::Index i = 0; i < size(); ++i)
    all.segment<freedoms<d>>(freedoms<d> * i) = each[static_cast<std::size_t>(i)];
  return all;
}

template <int d>
std::vector<Wrench<d>> Bodies<d>::System::known_forces() const {
  std::vector<Wrench<d>> sums(specs.size(), Wrench<d>::Zero());
  for (const auto& force : forces) force->add(at(kick, dt), sums);
  if (std::ranges::none_of(forces, [](const auto& force) { return force->is_of_velocity(); })) return sums;
  const auto now = predicted(sums);
  BodiesAt<d> at_now = at(kick, dt);
  at_now.states = now;
  std::ranges::fill(sums, Wrench<d>::Zero());
  for (const auto& force : forces) force->add(force->is_of_velocity() ? at_now : at(kick, dt), sums);
  return sums;
}

template <int d>
std::vector<BodyState<d>> Bodies<d>::System::predicted(std::span<const Wrench<d>> known) const {
  std::vector<BodyState<d>> now = states;
  const double since = kick - 0.5 * dt;  // t_n - t_{n-1/2}
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (answers(i)) now[i].velocity += since * acceleration(i, known[i]);
  return now;
}

template <int d>
Twist<d> Bodies<d>::System::acceleration(std::size_t i, Wrench<d> sum) const {
  if (!(specs[i].mass > 0)) return Twist<d>::Zero();
  if (loads.size() > 0) sum += loads.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i));
  Inertia<d> inertia_now = specs[i].inertia;
  if constexpr (d == 3) inertia_now = world_inertia(states[i].pose.linear(), inertia_now);
  Twist<d> change;
  change << sum.template head<d>() / specs[i].mass, inertia_now.ldlt().solve(sum.template tail<rotations<d>>());
  for (int k = 0; k < freedoms<d>; ++k)
    if (!specs[i].free[static_cast<std::size_t>(k)]) change[k] = 0;
  return change;
}

template <int d>
bool Bodies<d>::System::is_touched(std::size_t body) const {
  const std::size_t contacts_of_bodies = near.size() - stopped.size();
  for (std::size_t c = 0; c < contacts_of_bodies; ++c)
    if (constraints.closed(static_cast<Eigen::Index>(c)) && (near[c].body == body || near[c].other == body))
      return true;
  return false;
}

template <int d>
void Bodies<d>::System::release() {
  constexpr double roundoff = 1e-9;  // of a step: what sums of them miss
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (!held[i]) continue;
    const auto& asked = *specs[i].release;
    const bool is_loaded = loads.size() > 0 && asked.load &&
                           loads.segment<d>(freedoms<d> * static_cast<Eigen::Index>(i)).norm() >= *asked.load;
    if ((asked.time && time >= *asked.time - roundoff * dt) ||
        (asked.at_contact && (wetted_share[i] > 0 || is_touched(i))) || is_loaded)
      let_go(i);
  }
}

// Its next kick begins at t_{n-1/2}, but forces move it from t_n on: it has the path's velocity there.
template <int d>
void Bodies<d>::System::let_go(std::size_t i) {
  constexpr double instant = 1e-3;  // of a step: the path's slope before t_n
  held[i] = 0;
  std::vector<Wrench<d>> sums(specs.size(), Wrench<d>::Zero());
  for (const auto& force : forces) force->add(at(0, 0), sums);
  const double since = instant * dt;
  Twist<d>& velocity = states[i].velocity;
  velocity = displacement<d>(specs[i].path(time - since), specs[i].path(time)) / since;
  velocity -= 0.5 * dt * acceleration(i, sums[i]);
  trials[i] = states[i];
  const Isometry<3> pose = embedded<d>(states[i].pose);
  movers[i]->momentum = world_inertia(pose.linear(), lifted_inertia<d>(specs[i].inertia)) *
                        (embedding<d>() * velocity).template tail<3>();
}

template <int d>
double Bodies<d>::System::until_release() const {
  constexpr double growth = 1.5, roundoff = 1e-9;  // of steps: as those who choose them grow them; of their sums
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (!held[i] || !specs[i].release->time) continue;
    const double left = *specs[i].release->time - time;
    least = std::min(least, committed_dt > 0 && left > (1 + roundoff) * committed_dt && left < 2 * growth * committed_dt
                                ? left / 2
                                : left);
  }
  return least;
}

template <int d>
BodyState<d> Bodies<d>::System::prescribed(std::size_t i) const {
  const Isometry<d> to = specs[i].path(time + dt);
  return {to, displacement<d>(states[i].pose, to) / dt};
}

template <int d>
typename Bodies<d>::System::MassMatrix Bodies<d>::System::inertia(std::size_t i) const {
  return embedding<d>().transpose() * movers[i]->inertia() * embedding<d>();
}

template <int d>
void Bodies<d>::System::place(Eigen::Index i, const BodyState<d>& state) {
  bullet.place(static_cast<std::size_t>(i), embedded<d>(state.pose), embedding<d>() * state.velocity);
}

template <int d>
std::vector<Condition<d>> Bodies<d>::System::asked_by_joints() {
  std::vector<Condition<d>> all;
  for (const auto& c : bullet.conditions(dt)) all.push_back(projected_condition<d>(c));
  return all;
}

template <int d>
std::vector<Condition<d>> Bodies<d>::System::equalities() {
  std::vector<Condition<d>> all = tied;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const Twist<d>& velocity = answers(i) ? states[i].velocity : trials[i].velocity;
    for (int k = 0; k < freedoms<d>; ++k)
      if (!answers(i) || !specs[i].free[static_cast<std::size_t>(k)])
        all.push_back({i, {}, Wrench<d>::Unit(k), Wrench<d>::Zero(), velocity[k]});
  }
  return all;
}

template <int d>
Eigen::MatrixXd Bodies<d>::System::rows_of(const std::vector<Condition<d>>& conditions) const {
  return rigid::rows_of<d>(conditions, size());
}

template <int d>
void Bodies<d>::System::find_contacts() {
  near.clear();
  rubbing.clear();
  rebound.resize(0);
  if (!contacts) return;
  auto touching = contacts->within_reach(states, dt);
  std::erase_if(touching, [&](const Contact<d>& c) { return !answers(c.body) && !(c.other && answers(*c.other)); });
  near.assign(touching.begin(), touching.end());
  if (contacts->spec().friction > 0)
    for (const auto& contact : touching)
      std::ranges::copy(rigid::rubbing<d>(contact, states), std::back_inserter(rubbing));
  if (contacts->spec().restitution == 0) return;
  rebound.resize(static_cast<Eigen::Index>(near.size()));
  for (std::size_t c = 0; c < near.size(); ++c)
    rebound[static_cast<Eigen::Index>(c)] = rigid::rebound<d>(near[c], states, contacts->spec().restitution);
}

template <int d>
void Bodies<d>::System::find_stops_and_springs() {
  sprung.clear();
  stopped.clear();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointSpec& joint = joints[j];
    if (!joint.measured()) continue;
    const auto in_space = bullet.coordinate(j);
    if (joint.type == JointType::hinge)  // no step turns it by half a turn
      moved[j] += std::remainder(in_space.q - moved[j], 2 * std::numbers::pi);
    else
      moved[j] = in_space.q;
    const JointCoordinate<d> at{moved[j], projected_condition<d>(in_space.rate)};
    if (joint.spring) sprung.push_back({j, *joint.spring, at});
    const std::size_t before = near.size();
    add_stops(joint, at, dt, near);
    stopped.insert(stopped.end(), near.size() - before, j);
  }
}

template <int d>
void Bodies<d>::System::set_up_constraints() {
  for (Eigen::Index i = 0; i < size(); ++i) place(i, states[static_cast<std::size_t>(i)]);
  tied = asked_by_joints();
  find_contacts();
  find_stops_and_springs();
  pulls.clear();
  for (const auto& force : forces) force->pull(at(kick, dt), pulls);
  solve_conditions();
  if (tied.empty()) return;
  // Joints are met at x_{n+1}, but for what the fluid's load adds to the curvature of the way there (SHAKE, Ryckaert,
  // Ciccotti, Berendsen 1977): what a trial step without the load still violates goes into the rates.
  constexpr int trials_enough = 3;  // quadratic: (w dt)^2, ^4, ^8
  for (int k = 0; k < trials_enough; ++k) {
    drift(constraints.velocity(Eigen::VectorXd::Zero(freedoms<d> * size())));
    for (Eigen::Index i = 0; i < size(); ++i) place(i, trials[static_cast<std::size_t>(i)]);
    const auto at_end = asked_by_joints();
    for (std::size_t c = 0; c < tied.size(); ++c) tied[c].rate += at_end[c].rate;
    solve_conditions();
  }
}

template <int d>
void Bodies<d>::System::guess_contacts() {
  if ((near.empty() && pulls.empty()) || loads.size() == 0) return;
  ConstraintSolver guess = constraints;
  if (!guess.settled(kick * loads)) return;
  constraints = std::move(guess);
  constraints.forget_changes();
}

template <int d>
void Bodies<d>::System::solve_conditions() {
  ConstraintSolver::Problem p;
  p.before.setZero(freedoms<d> * size());
  p.unit.setOnes(freedoms<d> * size());
  p.inertia.setZero(freedoms<d> * size(), freedoms<d> * size());
  p.impulse.setZero(freedoms<d> * size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    const auto b = static_cast<std::size_t>(i);
    p.unit.segment(freedoms<d> * i + d, rotations<d>).setConstant(reaches[b]);
    p.before.segment<freedoms<d>>(freedoms<d> * i) = states[b].velocity;
    if (!answers(b)) continue;
    p.inertia.block<freedoms<d>, freedoms<d>>(freedoms<d> * i, freedoms<d> * i) = inertia(b);
    p.impulse.segment<freedoms<d>>(freedoms<d> * i) = embedding<d>().transpose() * movers[b]->impulse();
  }
  const auto equal = equalities();
  p.equalities = rows_of(equal);
  p.equal = rates_of(equal);
  p.contacts = rows_of(near);
  p.least = rates_of(near);
  p.tangents = rows_of(rubbing);
  p.rubbing = static_cast<int>(rubbing.size()) / (d - 1);
  constexpr double flush = 1e-10;  // of the bodies' lengths: what positions do not resolve
  p.resolution = flush * p.unit.maxCoeff() / dt;
  part_overlaps(p);
  p.least = p.least.cwiseMin(0);
  p.least.head(rebound.size()) = p.least.head(rebound.size()).cwiseMax(rebound);
  if (contacts) p.friction = contacts->spec().friction;
  add_springs(p);
  add_pulls(p);
  constraints = ConstraintSolver(p);
  problem = std::move(p);
}

template <int d>
void Bodies<d>::System::part_overlaps(ConstraintSolver::Problem p) {
  apart.setZero(freedoms<d> * size());
  if ((p.least.array() <= p.resolution).all()) return;
  p.before.setZero();
  p.equal.setZero();
  p.impulse.setZero();
  p.rubbing = 0;
  p.tangents.resize(0, p.tangents.cols());
  ConstraintSolver parting(p);
  if (const auto found = parting.settled(p.impulse)) apart = *found;
}

template <int d>
void Bodies<d>::System::add_springs(ConstraintSolver::Problem& p) const {
  const double dt_before = 2 * kick - dt;
  for (const auto& [joint, spring, at] : sprung) {
    const Eigen::MatrixXd row = rows_of({at.rate});
    const double q_rate = (row * p.before)[0];
    const double lag = at.q - spring.rest + (dt - dt_before) / 4 * q_rate;
    const double later = weight_of_later(kick * spring.damping * compliance<d>(at.rate, specs, states, held));
    p.impulse -= kick * (spring.stiffness * lag + spring.damping * q_rate) * row.transpose();
    p.inertia += kick * (spring.stiffness * dt / 4 + later * spring.damping) * row.transpose() * row;
  }
}

template <int d>
void Bodies<d>::System::add_pulls(ConstraintSolver::Problem& p) const {
  std::vector<Condition<d>> against;
  std::vector<double> inertias;
  for (const Pull<d>& pull : pulls) {
    if (pull.one_sided) {
      const auto& q = pull.rate;
      against.push_back({q.body, q.other, -q.first, -q.second, pull.impulse / pull.inertia});
      inertias.push_back(pull.inertia);
      continue;
    }
    const Eigen::MatrixXd row = rows_of({pull.rate});
    p.impulse -= (pull.impulse + pull.inertia * (row * p.before)[0]) * row.transpose();
    p.inertia += pull.inertia * row.transpose() * row;
  }
  if (against.empty()) return;
  const Eigen::Index hard = p.contacts.rows(), all = hard + static_cast<Eigen::Index>(against.size());
  p.contacts.conservativeResize(all, freedoms<d> * size());
  p.contacts.bottomRows(all - hard) = rows_of(against);
  p.least.conservativeResize(all);
  p.least.tail(all - hard) = rates_of(against);
  p.yielding = Eigen::Map<const Eigen::VectorXd>(inertias.data(), all - hard);
}

template <int d>
void Bodies<d>::System::drift(const Eigen::VectorXd& velocities) {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (!answers(i)) continue;
    const Twist<d> s = velocities.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i));
    const Twist<d> moves = s + apart.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i));
    bullet.place(i, embedded<d>(states[i].pose), embedding<d>() * (s.allFinite() ? moves : Twist<d>::Zero().eval()));
  }
  bullet.drift(dt);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (!answers(i)) continue;
    trials[i] = {projected<d>(bullet.pose(i)),
                 velocities.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i))};
    if (!trials[i].velocity.allFinite())
      trials[i].pose.matrix().template topRows<d>().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  phase = Phase::solved;
}

template <int d>
Status Bodies<d>::System::passes_through() const {
  if (!contacts) return {};
  std::vector<BodyState<d>> reaching = states;
  bool faster = false;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    faster = faster || trials[i].velocity.norm() > states[i].velocity.norm();
    reaching[i].velocity = trials[i].velocity;
  }
  if (!faster) return {};
  for (const Condition<d>& c : contacts->within_reach(reaching, dt)) {
    if (!answers(c.body) && !(c.other && answers(*c.other))) continue;
    if (std::ranges::any_of(near, [&](const Condition<d>& n) { return n.body == c.body && n.first == c.first; }))
      continue;
    if (crosses(c))
      return {message("a body passes through what it touches within the step: \"", specs[c.body].name, "\"")};
  }
  return {};
}

template <int d>
bool Bodies<d>::System::crosses(const Condition<d>& c) const {
  double speed = trials[c.body].velocity.norm();
  if (c.other) speed += trials[*c.other].velocity.norm();
  constexpr double roundoff = 1e-6;  // of the speed
  return rate_of<d>(c, trials) <
         std::min(c.rate, 0.0) - constraints.resolution() - roundoff * speed * (1 + reaches[c.body]);
}

template <int d>
Status Bodies<d>::System::squeezed() const {
  const auto cause = [](const std::string& body, const std::string& what) {
    return Status{message("bodies close in on \"", body, "\", ", what)};
  };
  for (const Condition<d>& c : near)
    if (crosses(c)) return cause(specs[c.other && !answers(c.body) ? *c.other : c.body].name, "which has no room left");
  // A wedge of three degrees between two contacts; positions and hulls do not know angles better than some tenths of one.
  constexpr double most = 20;
  if (constraints.leverage() <= most) return {};
  const Eigen::VectorXd asked = constraints.asked();
  double fastest = 0;
  std::size_t of = 0;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const double speed =
        farthest_speed<d>(asked.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i)), reaches[i]);
    if (speed > fastest) fastest = speed, of = i;
  }
  return cause(specs[of].name, message("which would leave more than ", most, " times as fast as they come"));
}

template struct Bodies<2>::System;
template struct Bodies<3>::System;

}  // namespace splashdown::rigid
