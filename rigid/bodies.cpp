#include "rigid/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>

#include "core/geometry.hpp"
#include "rigid/embedding.hpp"
#include "rigid/message.hpp"
#include "rigid/system.hpp"

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
  return {embedded<d>(state.pose), embedding<d>() * state.velocity};
}

}  // namespace

template <int d>
Bodies<d>::Bodies(std::vector<BodySpec<d>> specs, std::vector<std::unique_ptr<Force<d>>> forces,
                  std::vector<JointSpec> joints, std::optional<ContactSpec<d>> contacts)
    : system_(std::make_unique<System>()) {
  System& w = *system_;
  w.specs = std::move(specs);
  w.forces = std::move(forces);
  for (const BodySpec<d>& spec : w.specs) {
    check(spec);
    w.reaches.push_back(reach(spec));
    w.hull_measures.push_back(splashdown::measure<d>(spec.surface));
    const bool held_still = spec.motion == BodyMotion::fixed;
    const Isometry<d> pose = spec.motion == BodyMotion::prescribed ? spec.path(0) : spec.pose;
    w.states.push_back({pose, held_still ? Twist<d>::Zero().eval() : spec.velocity});
    w.movers.emplace_back();
    w.held.push_back(spec.release.has_value());
    w.bullet.add(spec.becomes_free());
    w.bullet.place(w.states.size() - 1, embedded<d>(pose), Twist<3>::Zero());
    if (!spec.becomes_free()) continue;

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
    w.joints.push_back(joint);
    w.moved.push_back(0);
    if (contacts && joint.other) contacts->apart.insert(std::minmax(joint.body, *joint.other));
  }
  if (contacts) w.contacts.emplace(std::move(*contacts), w.specs);
  w.trials = w.states;
  w.wetted_share.assign(w.specs.size(), 0.0);
}

template <int d>
Bodies<d>::~Bodies() = default;
template <int d>
Bodies<d>::Bodies(Bodies&&) noexcept = default;
template <int d>
Bodies<d>& Bodies<d>::operator=(Bodies&&) noexcept = default;

template <int d>
std::size_t Bodies<d>::size() const {
  return system_->specs.size();
}
template <int d>
const BodySpec<d>& Bodies<d>::spec(std::size_t body) const {
  return system_->specs.at(body);
}
template <int d>
const BodyState<d>& Bodies<d>::state(std::size_t body) const {
  return system_->states.at(body);
}
template <int d>
std::span<const BodyState<d>> Bodies<d>::states() const {
  return system_->states;
}
template <int d>
std::span<const BodyState<d>> Bodies<d>::trials() const {
  return system_->trials;
}
template <int d>
double Bodies<d>::time() const {
  return system_->time;
}

template <int d>
bool Bodies<d>::answers(std::size_t body) const {
  return system_->answers(body);
}

template <int d>
void Bodies<d>::begin(double kick, double dt) {
  System& w = *system_;
  if (!(kick > 0 && dt > 0 && std::isfinite(kick) && std::isfinite(dt)))
    throw std::invalid_argument(message("bodies: kick = ", kick, " s and dt = ", dt, " s must be positive"));
  w.kick = kick;
  w.dt = dt;
  const auto forces = w.known_forces();
  for (std::size_t i = 0; i < size(); ++i) {
    if (w.movers[i]) w.movers[i]->begin(lifted_state(w.states[i]), embedding<d>() * (kick * forces[i]), dt);
    if (w.specs[i].motion == BodyMotion::prescribed && !w.answers(i)) w.trials[i] = w.prescribed(i);
  }
  w.set_up_constraints();
  w.guess_contacts();
  w.impulses.resize(0);
  w.phase = System::Phase::begun;
}

template <int d>
Response Bodies<d>::response() const {
  const System& w = *system_;
  w.expect(w.phase != System::Phase::committed, "response needs begin first");
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(freedoms<d> * w.size());
  const Eigen::VectorXd s = w.constraints.velocity(none);
  return {.free = s,
          .modal = {.modes = w.constraints.modes(), .inertia = w.constraints.inertia()},
          .contacts = {.directions = w.constraints.directions(),
                       .known = w.constraints.unspent(s, none),
                       .workless = w.constraints.workless()}};
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::solve(std::span<const Wrench<d>> loads) {
  return solve(Eigen::VectorXd(system_->kick * system_->stacked(loads)));
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::solve(const Eigen::VectorXd& impulses) {
  System& w = *system_;
  w.expect(w.phase != System::Phase::committed, "solve needs begin first");
  w.expect_all(impulses);
  w.constraints.forget_changes();
  const auto velocity = w.constraints.settled(impulses);
  w.impulses = impulses;
  w.drift(velocity ? *velocity : Eigen::VectorXd::Constant(impulses.size(), std::numeric_limits<double>::quiet_NaN()));
  return w.trials;
}

template <int d>
std::span<const BodyState<d>> Bodies<d>::adopt(const Eigen::VectorXd& velocities) {
  System& w = *system_;
  w.expect(w.phase != System::Phase::committed, "adopt needs begin first");
  w.expect_all(velocities);
  w.drift(velocities);
  return w.trials;
}

template <int d>
bool Bodies<d>::update_contacts(const Eigen::VectorXd& impulses) {
  System& w = *system_;
  w.expect(w.phase == System::Phase::solved, "update_contacts needs a trial first");
  w.expect_all(impulses);
  Eigen::VectorXd velocities(freedoms<d> * w.size());
  for (Eigen::Index i = 0; i < w.size(); ++i)
    velocities.segment<freedoms<d>>(freedoms<d> * i) = w.trials[static_cast<std::size_t>(i)].velocity;
  w.impulses = impulses;
  return w.constraints.update_contacts(velocities, impulses);
}

template <int d>
Status Bodies<d>::acceptable() const {
  const System& w = *system_;
  w.expect(w.phase == System::Phase::solved, "acceptable needs a trial first");
  constexpr double most_turn = 1;  // [rad] beyond which the way there is not that of a step
  for (std::size_t i = 0; i < size(); ++i) {
    const double turn = w.dt * w.trials[i].velocity.template tail<rotations<d>>().norm();
    if (w.answers(i) && turn > most_turn)
      return {message("a body turns too far within the step: \"", w.specs[i].name, "\" by ", turn, " rad")};
  }
  if (const auto status = w.squeezed(); !status.ok()) return status;
  return w.passes_through();
}

template <int d>
void Bodies<d>::commit() {
  System& w = *system_;
  w.expect(w.phase == System::Phase::solved, "commit needs solve first");
  for (std::size_t i = 0; i < size(); ++i) {
    if (w.movers[i]) w.movers[i]->commit(embedding<d>() * w.trials[i].velocity);
  }
  for (const auto& force : w.forces) force->commit(w.tried());
  w.states = w.trials;
  w.time += w.dt;
  w.committed_dt = w.dt;
  if (w.impulses.size() > 0) w.loads = w.impulses / w.kick;
  w.release();
  w.phase = System::Phase::committed;
}

template <int d>
void Bodies<d>::see_wetted(std::span<const double> measures) {
  System& w = *system_;
  if (measures.size() != size())
    throw std::invalid_argument(message("bodies: wetted measures of ", measures.size(), " of ", size(), " bodies"));
  for (std::size_t i = 0; i < size(); ++i)
    w.wetted_share[i] = w.hull_measures[i] > 0 ? std::clamp(measures[i] / w.hull_measures[i], 0.0, 1.0) : 0.0;
}

template <int d>
double Bodies<d>::stable_dt() const {
  double dt = system_->until_release();
  for (const auto& force : system_->forces) dt = std::min(dt, force->stable_dt(system_->at(0, 0)));
  return dt;
}

template <int d>
std::vector<Diagnostic> Bodies<d>::diagnostics() const {
  std::vector<Diagnostic> all;
  for (const auto& force : system_->forces)
    for (const auto& [name, value] : force->diagnostics(system_->tried()))
      all.emplace_back(force->name() + "_" + name, value);
  for (auto& reaction : system_->reactions()) all.push_back(std::move(reaction));
  return all;
}

template <int d>
void Bodies<d>::save(std::ostream& out) const {
  const System& w = *system_;
  const double count = static_cast<double>(size());
  write(out, &count, 1);
  write(out, &w.time, 1);
  for (std::size_t i = 0; i < size(); ++i) {
    write(out, w.states[i].pose.data(), w.states[i].pose.matrix().size());
    write(out, w.states[i].velocity.data(), freedoms<d>);
    if (w.movers[i]) write(out, w.movers[i]->momentum.data(), 3);
  }
  for (std::size_t j = 0; j < w.joints.size(); ++j)
    if (w.joints[j].measured()) write(out, &w.moved[j], 1);
  const double loads = static_cast<double>(w.loads.size());
  write(out, &loads, 1);
  write(out, w.loads.data(), w.loads.size());
  write(out, w.wetted_share.data(), w.size());
  write(out, &w.committed_dt, 1);
  out.write(w.held.data(), static_cast<std::streamsize>(size()));
  for (const auto& force : w.forces) force->save(out);
}

template <int d>
void Bodies<d>::load(std::istream& in) {
  System& w = *system_;
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
  for (std::size_t j = 0; j < w.joints.size(); ++j)
    if (w.joints[j].measured()) read(in, &w.moved[j], 1);
  double loads = 0;
  read(in, &loads, 1);
  if (loads != 0 && loads != static_cast<double>(freedoms<d> * w.size()))
    throw std::runtime_error("the bodies' loads are damaged");
  w.loads.resize(static_cast<Eigen::Index>(loads));
  read(in, w.loads.data(), w.loads.size());
  read(in, w.wetted_share.data(), w.size());
  read(in, &w.committed_dt, 1);
  w.dt = w.committed_dt;
  in.read(w.held.data(), static_cast<std::streamsize>(size()));
  for (const auto& force : w.forces) force->load(in);
  if (!in) throw std::runtime_error("ends in the middle of the bodies");
  constexpr double roundoff = 1e-6;  // of rotations, far above what they gather
  bool good = std::isfinite(w.time) && w.loads.allFinite();
  for (const auto& state : w.states)
    good = good && state.pose.matrix().allFinite() && state.pose.linear().isUnitary(roundoff) &&
           state.velocity.allFinite();
  for (const double share : w.wetted_share) good = good && share >= 0 && share <= 1;
  good = good && w.committed_dt >= 0 && std::isfinite(w.committed_dt);
  for (std::size_t i = 0; i < size(); ++i) good = good && (w.held[i] == 0 || (w.held[i] == 1 && w.specs[i].release));
  for (const double moved : w.moved) good = good && std::isfinite(moved);
  for (const auto& mover : w.movers) good = good && (!mover || mover->momentum.allFinite());
  if (!good) throw std::runtime_error("the bodies' state is damaged");
  w.trials = w.states;
  w.phase = System::Phase::committed;
}

template class Bodies<2>;
template class Bodies<3>;

}  // namespace splashdown::rigid
