#include "rigid/rest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/dense.hpp"
#include "core/geometry.hpp"
#include "rigid/bullet_engine.hpp"
#include "rigid/buoyancy.hpp"
#include "rigid/constraints/condition_rows.hpp"
#include "rigid/constraints/constraint_solver.hpp"
#include "rigid/shapes/inclined_hull.hpp"

namespace splashdown::rigid {

namespace {

/// Of each pair of bodies the places that are nearest to touching: a round body has hundreds that are near. What is left out
/// comes in when it is nearer.
template <int d>
std::vector<Condition<d>> nearest_of(const std::vector<Contact<d>>& touching) {
  std::vector<Condition<d>> sorted(touching.begin(), touching.end()), kept;
  std::ranges::stable_sort(sorted, std::greater<>(), &Condition<d>::rate);
  const long most = 12;
  for (const auto& c : sorted) {
    const auto same = [&](const Condition<d>& k) { return k.body == c.body && k.other == c.other; };
    if (std::ranges::count_if(kept, same) < most) kept.push_back(c);
  }
  return kept;
}

template <int d>
class Settling {
 public:
  Settling(const Mechanism<d>& mechanism, const StillWater& water);
  Rest<d> rest();

 private:
  using States = std::vector<BodyState<d>>;
  /// Where bodies are, and their joints' coordinates there.
  struct Place {
    States states;
    std::vector<double> moved;
  };
  struct Conditions {
    std::vector<Condition<d>> tied, near;
    std::vector<JointCoordinate<d>> joints;
  };

  Eigen::Index size() const { return static_cast<Eigen::Index>(bodies_.size()); }
  bool is_free(std::size_t body) const { return bodies_[body].motion == BodyMotion::free; }
  /// Meets joints and contacts at a place, whose joint coordinates it counts on from where they were.
  Conditions conditions(Place& at, double within);
  ConstraintSolver::Problem problem(const Conditions& conditions) const;
  Potential<d> potential(const Place& at, const Conditions& conditions) const;
  /// A displacement, and back onto joints and out of contacts.
  Place displaced(const Place& from, const Eigen::VectorXd& by);
  void displace(Place& place, const Eigen::VectorXd& by) const;
  /// What joints add to the stiffness in the motions they leave, for they turn as the bodies move.
  Eigen::MatrixXd joint_stiffness(const Place& at, const Conditions& conditions, const Eigen::VectorXd& force,
                                  const Eigen::MatrixXd& modes);
  Eigen::VectorXd step(const Place& at, const Conditions& conditions, const Potential<d>& now);
  double stride(const Place& at) const;
  double farthest(const Eigen::VectorXd& displacement) const {
    return unit_.cwiseProduct(displacement).cwiseAbs().maxCoeff();
  }
  bool goes_down(const Place& at, std::size_t body) const;
  void flood(const Place& at);

  const std::vector<BodySpec<d>>& bodies_;
  const std::vector<JointSpec>& joints_;
  StillWater water_;
  std::optional<Contacts<d>> contacts_;
  BulletEngine bullet_;
  std::vector<FloatingHull<d>> hulls_;
  std::vector<double> reaches_;
  Eigen::VectorXd unit_;
  Place begin_;
  double size_ = 0, stiff_ = 0;  // the smallest body [m]; of water planes [N/m]
  bool unstable_ = false;        // the last step left an unstable balance
};

template <int d>
Settling<d>::Settling(const Mechanism<d>& mechanism, const StillWater& water)
    : bodies_(mechanism.bodies), joints_(mechanism.joints), water_(water), unit_(freedoms<d> * size()) {
  size_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto& spec = bodies_[i];
    hulls_.emplace_back(spec.surface, i < mechanism.hollows.size() ? mechanism.hollows[i] : Hollow::dry);
    begin_.states.push_back({spec.motion == BodyMotion::prescribed ? spec.path(0) : spec.pose, Twist<d>::Zero()});
    reaches_.push_back(reach(spec));
    bullet_.add(spec.motion == BodyMotion::free);
    bullet_.place(i, embedded<d>(begin_.states[i].pose), Twist<3>::Zero());
    unit_.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i)) << Vec<d>::Ones(),
        Rotation<d>::Constant(reaches_[i]);
    if (!is_free(i)) continue;
    size_ = std::min(size_, reaches_[i]);
    stiff_ += water.density * water.gravity * std::pow(reaches_[i], d - 1);
  }
  auto touching = mechanism.contacts;
  for (const JointSpec& joint : joints_) {
    check(joint, bodies_.size());
    bullet_.add(joint);
    begin_.moved.push_back(0);
    if (touching && joint.other) touching->apart.insert(std::minmax(joint.body, *joint.other));
  }
  if (touching) contacts_.emplace(std::move(*touching), bodies_);
  flood(begin_);
}

/// Hollows whose rims are under water are flooded, for good.
template <int d>
void Settling<d>::flood(const Place& at) {
  for (std::size_t i = 0; i < hulls_.size(); ++i) {
    if (hulls_[i].state == Hollow::flooded || !hulls_[i].hollows.possible()) continue;
    const auto& pose = at.states[i].pose;
    const InclinedHull<d> inclined(hulls_[i], pose.linear());
    if (!inclined.rims().empty() && inclined.rims().front() <= water_.level - pose.translation()(d - 1))
      hulls_[i].state = Hollow::flooded;
  }
}

template <int d>
typename Settling<d>::Conditions Settling<d>::conditions(Place& at, double within) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) bullet_.place(i, embedded<d>(at.states[i].pose), Twist<3>::Zero());
  Conditions all;
  const double at_once = 1;  // displacements in place of velocities
  for (const auto& c : bullet_.conditions(at_once)) all.tied.push_back(projected_condition<d>(c));
  if (contacts_) {
    auto reaching = at.states;
    for (auto& state : reaching) state.velocity(0) = within;
    const auto touching = contacts_->within_reach(reaching, at_once);
    all.near = nearest_of<d>(touching);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!joints_[j].measured()) {
      all.joints.emplace_back();
      continue;
    }
    const auto in_space = bullet_.coordinate(j);
    if (joints_[j].type == JointType::hinge)
      at.moved[j] += std::remainder(in_space.q - at.moved[j], 2 * std::numbers::pi);
    else
      at.moved[j] = in_space.q;
    all.joints.push_back({at.moved[j], projected_condition<d>(in_space.rate)});
    add_stops(joints_[j], all.joints.back(), at_once, all.near);
  }
  return all;
}

template <int d>
ConstraintSolver::Problem Settling<d>::problem(const Conditions& conditions) const {
  std::vector<Condition<d>> equal = conditions.tied;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (int k = 0; k < freedoms<d>; ++k)
      if (!is_free(i) || !bodies_[i].free[static_cast<std::size_t>(k)])
        equal.push_back({i, {}, Wrench<d>::Unit(k), Wrench<d>::Zero(), 0});
  const Eigen::Index n = freedoms<d> * size();
  ConstraintSolver::Problem p;
  p.before.setZero(n);
  p.unit = unit_;
  p.equalities = rows_of<d>(equal, size());
  p.equal = rates_of<d>(equal);
  p.contacts = rows_of<d>(conditions.near, size());
  p.least = rates_of<d>(conditions.near);
  p.resolution = 1e-11 * size_;
  p.tangents.resize(0, n);
  p.inertia = unit_.cwiseAbs2().asDiagonal();
  p.impulse.setZero(n);
  return p;
}

template <int d>
Potential<d> Settling<d>::potential(const Place& at, const Conditions& conditions) const {
  const double weight_of_water = water_.density * water_.gravity;
  Potential<d> p;
  p.force.setZero(freedoms<d> * size());
  p.stiffness.setZero(p.force.size(), p.force.size());
  p.submerged.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!is_free(i)) continue;
    const auto& pose = at.states[i].pose;
    const Eigen::Index first = freedoms<d> * static_cast<Eigen::Index>(i);
    const double height = pose.translation()(d - 1) - water_.level, weight = bodies_[i].mass * water_.gravity;
    p.energy += weight * height;
    p.force(first + d - 1) -= weight;
    if (height > reaches_[i]) continue;
    auto& s = p.submerged[i] = InclinedHull<d>(hulls_[i], pose.linear()).submerged(-height, -height);
    const double lift = weight_of_water * s.volume;
    p.energy -= lift * (s.centre(d - 1) + height);
    p.force.template segment<freedoms<d>>(first) += wrench_of<d>(s.centre, lift * Vec<d>::Unit(d - 1));
    p.stiffness.template block<freedoms<d>, freedoms<d>>(first, first) = weight_of_water * buoyant_stiffness<d>(s);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!joints_[j].spring) continue;
    const auto& spring = *joints_[j].spring;
    const double stretch = at.moved[j] - spring.rest;
    const Eigen::VectorXd row = rows_of<d>({conditions.joints[j].rate}, size()).transpose();
    p.energy += 0.5 * spring.stiffness * stretch * stretch;
    p.force -= spring.stiffness * stretch * row;
    p.stiffness += spring.stiffness * row * row.transpose();
  }
  return p;
}

template <int d>
void Settling<d>::displace(Place& place, const Eigen::VectorXd& by) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Twist<d> motion = by.segment<freedoms<d>>(freedoms<d> * static_cast<Eigen::Index>(i));
    if (is_free(i) && !motion.isZero(0)) place.states[i].pose = moved<d>(place.states[i].pose, motion, 1);
  }
}

template <int d>
typename Settling<d>::Place Settling<d>::displaced(const Place& from, const Eigen::VectorXd& by) {
  Place to = from;
  displace(to, by);
  const int rounds = 8;  // quadratic
  for (int i = 0; i < rounds && (!joints_.empty() || contacts_); ++i) {
    const auto p = problem(conditions(to, 0));
    ConstraintSolver back(p);
    const auto found = back.settled(p.impulse);
    if (!found || farthest(*found) < 1e-13 * size_) break;
    displace(to, *found);
  }
  for (auto& state : to.states) {  // round-off of many turns
    const Eigen::JacobiSVD<Mat<d>> turn(state.pose.linear(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    state.pose.linear() = turn.matrixU() * turn.matrixV().transpose();
  }
  return to;
}

template <int d>
Eigen::MatrixXd Settling<d>::joint_stiffness(const Place& at, const Conditions& conditions,
                                             const Eigen::VectorXd& force, const Eigen::MatrixXd& modes) {
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(modes.cols(), modes.cols());
  if (conditions.tied.empty()) return added;
  const Eigen::MatrixXd rows = rows_of<d>(conditions.tied, size());
  const Eigen::VectorXd forces = algebra::least_squares(problem(conditions).equalities.transpose(), -force);
  const Eigen::VectorXd tied = forces.head(rows.rows());
  const double small = 1e-6 * size_, same = 1e-3;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    Place beside = at;
    displace(beside, small * modes.col(k));
    const Eigen::MatrixXd there = rows_of<d>(this->conditions(beside, 0).tied, size());
    if (there.rows() != rows.rows()) continue;
    Eigen::MatrixXd change = there - rows;
    for (Eigen::Index r = 0; r < rows.rows(); ++r)  // Bullet may change to another basis
      if (change.row(r).norm() > same * (1 + rows.row(r).norm())) change.row(r).setZero();
    added.col(k) = -modes.transpose() * (change.transpose() * tied) / small;
  }
  return 0.5 * (added + added.transpose());
}

template <int d>
Eigen::VectorXd Settling<d>::step(const Place& at, const Conditions& conditions, const Potential<d>& now) {
  auto p = problem(conditions);
  const Eigen::MatrixXd modes = ConstraintSolver(p).modes();
  if (modes.cols() == 0) return Eigen::VectorXd::Zero(p.before.size());
  const double neutral = facets_share * stiff_, balance = 1e-9 * stiff_ * size_;
  const Eigen::MatrixXd stiffness =
      algebra::congruence(now.stiffness, modes) + joint_stiffness(at, conditions, now.force, modes);
  const auto principal = algebra::principal_of(stiffness);
  const Eigen::VectorXd along = principal.directions.transpose() * (modes.transpose() * now.force);
  Eigen::VectorXd curvatures = principal.values, pushes = along;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    if (std::abs(curvatures[k]) <= neutral && std::abs(along[k]) <= 0.1 * neutral * size_) pushes[k] = 0;
    curvatures[k] = std::max(std::abs(curvatures[k]), neutral);
  }
  // Both as on all bodies: modes^T (U^2 modes) = 1.
  const Eigen::MatrixXd dual = unit_.cwiseAbs2().asDiagonal() * modes * principal.directions;
  p.inertia = algebra::lifted(dual, curvatures.asDiagonal());
  p.impulse = dual * pushes;
  ConstraintSolver motions(p);
  const auto found = motions.settled(Eigen::VectorXd::Zero(p.impulse.size()));
  Eigen::VectorXd step = found ? *found : Eigen::VectorXd::Zero(p.before.size());
  const double most = stride(at), length = farthest(step);
  unstable_ = length <= balance / stiff_ && principal.values[0] < -neutral;
  if (unstable_) {
    const Eigen::VectorXd off = modes * principal.directions.col(0);
    const double turns = unit_.cwiseProduct(off).sum();
    return (turns < 0 ? -most : most) / farthest(off) * off;
  }
  return length > most ? Eigen::VectorXd(most / length * step) : step;
}

/// A twentieth of a body; while all are dry, half of the way to the water.
template <int d>
double Settling<d>::stride(const Place& at) const {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (is_free(i)) gap = std::min(gap, at.states[i].pose.translation()(d - 1) - reaches_[i] - water_.level);
  const bool may_fall = joints_.empty() && !contacts_;
  return std::max(0.05 * size_, may_fall ? 0.5 * gap : 0);
}

template <int d>
bool Settling<d>::goes_down(const Place& at, std::size_t body) const {
  const double before = begin_.states[body].pose.translation()(d - 1), below = 30 * reaches_[body];
  return is_free(body) && at.states[body].pose.translation()(d - 1) < std::min(before, water_.level) - below;
}

template <int d>
Rest<d> Settling<d>::rest() {
  const int iterations = 5000, halvings = 30;
  Place now = displaced(begin_, Eigen::VectorXd::Zero(unit_.size()));
  Conditions asked = conditions(now, stride(now));
  Potential<d> at = potential(now, asked);
  Rest<d> rest;
  const double round_off = 1e-13;
  for (int i = 0; i < iterations && !rest.found; ++i) {
    Eigen::VectorXd by = step(now, asked, at);
    if (farthest(by) <= 1e-10 * size_) rest.found = true;
    bool better = false;
    for (int k = 0; k < halvings && !better && !rest.found; ++k, by *= 0.5) {
      Place next = displaced(now, by);
      auto there = conditions(next, stride(next));
      auto next_at = potential(next, there);
      const double noise = round_off * (std::abs(at.energy) + stiff_ * size_ * size_);
      better = next_at.energy < at.energy + (unstable_ ? 0 : noise);
      if (!better && unstable_ && k == 0) by *= -2;
      if (!better) continue;
      now = std::move(next), asked = std::move(there), at = std::move(next_at);
    }
    if (!better) rest.found = true;
    flood(now);
    for (std::size_t b = 0; b < bodies_.size(); ++b) rest.found = rest.found || goes_down(now, b);
  }
  rest.energy = at.energy;
  rest.moved = now.moved;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    BodyAtRest<d> body;
    body.pose = now.states[b].pose;
    const double level = water_.level - body.pose.translation()(d - 1);
    const InclinedHull<d> inclined(hulls_[b], body.pose.linear());
    body.submerged = at.submerged[b];
    body.submerged.centre += body.pose.translation();
    body.draft = level - inclined.lowest();
    body.freeboard = inclined.rim_above(level, no_rim) - level;
    body.hollow = hulls_[b].state;
    body.sinks = goes_down(now, b);
    rest.bodies.push_back(body);
  }
  const double touching = 1e-6 * size_;
  if (contacts_)
    for (const auto& c : contacts_->within_reach(now.states, 1))
      if (std::abs(c.rate) <= touching) {
        rest.bodies[c.body].touches = true;
        if (c.other) rest.bodies[*c.other].touches = true;
      }
  return rest;
}

}  // namespace

template <int d>
Rest<d> at_rest(const Mechanism<d>& mechanism, const StillWater& water) {
  return Settling<d>(mechanism, water).rest();
}

template Rest<2> at_rest<2>(const Mechanism<2>&, const StillWater&);
template Rest<3> at_rest<3>(const Mechanism<3>&, const StillWater&);

}  // namespace splashdown::rigid
