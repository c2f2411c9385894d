// What joints and contacts did to bodies in the step that was tried: Newton's law read backwards.
//
//   M (s - s_before) - impulses known and of the fluid - those of lines = E^T l + D^T r + T^T t
//
// in the sense of least norm where conditions repeat each other.
#include "core/dense.hpp"
#include "rigid/system.hpp"

namespace splashdown::rigid {

namespace {

void add_columns(const std::string& name, const Wrench<2>& on_body, std::vector<Diagnostic>& all) {
  const char* const columns[] = {"_fx", "_fy", "_mz"};
  for (int k = 0; k < freedoms<2>; ++k) all.emplace_back(name + columns[k], on_body[k]);
}

void add_columns(const std::string& name, const Wrench<3>& on_body, std::vector<Diagnostic>& all) {
  const char* const columns[] = {"_fx", "_fy", "_fz", "_mx", "_my", "_mz"};
  for (int k = 0; k < freedoms<3>; ++k) all.emplace_back(name + columns[k], on_body[k]);
}

}  // namespace

template <int d>
Eigen::VectorXd Bodies<d>::System::reaction_impulses() const {
  const auto& p = problem;
  Eigen::VectorXd after(freedoms<d> * size());
  for (Eigen::Index i = 0; i < size(); ++i)
    after.segment<freedoms<d>>(freedoms<d> * i) = trials[static_cast<std::size_t>(i)].velocity;
  Eigen::VectorXd left = p.inertia * (after - p.before) - p.impulse;
  if (impulses.size() > 0) left -= impulses;
  const auto hard = static_cast<Eigen::Index>(near.size());
  for (Eigen::Index i = 0; i < p.yielding.size(); ++i) {
    const auto row = p.contacts.row(hard + i);
    if (constraints.closed(hard + i)) left -= p.yielding[i] * (p.least[hard + i] - row.dot(after)) * row.transpose();
  }
  const Eigen::Index ties = p.equalities.rows();
  if (ties + hard + p.tangents.rows() == 0) return {};
  Eigen::MatrixXd rows(ties + hard + p.tangents.rows(), after.size());
  rows.topRows(ties) = p.equalities;
  rows.middleRows(ties, hard) = p.contacts.topRows(hard);
  rows.bottomRows(p.tangents.rows()) = p.tangents;
  for (Eigen::Index c = 0; c < hard; ++c)
    if (!constraints.closed(c)) {
      rows.row(ties + c).setZero();
      if (c < p.rubbing) rows.middleRows(ties + hard + (d - 1) * c, d - 1).setZero();
    }
  // In units in which all velocities are m/s.
  const Eigen::MatrixXd scaled = rows * p.unit.cwiseInverse().asDiagonal();
  return algebra::least_squares(scaled.transpose(), left.cwiseQuotient(p.unit));
}

template <int d>
Wrench<d> Bodies<d>::System::spring_force(const Sprung& of) const {
  const auto& [joint, spring, at] = of;
  const double dt_before = 2 * kick - dt, before = rate_of<d>(at.rate, states), after = rate_of<d>(at.rate, trials);
  const double later = weight_of_later(kick * spring.damping * compliance<d>(at.rate, specs, states, held));
  const double q = at.q - spring.rest + (dt * after - dt_before * before) / 4;
  return -(spring.stiffness * q + spring.damping * (before + later * (after - before))) * at.rate.first;
}

template <int d>
std::vector<Diagnostic> Bodies<d>::System::reactions() const {
  std::vector<Diagnostic> all;
  if (joints.empty() && !contacts) return all;
  std::vector<Wrench<d>> of_joints(joints.size(), Wrench<d>::Zero()), of_contacts(specs.size(), Wrench<d>::Zero());
  if (phase == Phase::solved) {
    const Eigen::VectorXd found = reaction_impulses() / kick;
    const auto first_near = static_cast<std::size_t>(problem.equalities.rows());
    const std::size_t touching = near.size() - stopped.size();
    for (std::size_t c = 0; c < tied.size(); ++c)
      of_joints[bullet.joint_of_condition()[c]] += found[static_cast<Eigen::Index>(c)] * tied[c].first;
    for (const Sprung& each : sprung) of_joints[each.joint] += spring_force(each);
    for (std::size_t c = 0; c < near.size() + rubbing.size(); ++c) {
      const Condition<d>& condition = c < near.size() ? near[c] : rubbing[c - near.size()];
      const double push = found[static_cast<Eigen::Index>(first_near + c)];
      if (c >= touching && c < near.size()) {
        of_joints[stopped[c - touching]] += push * condition.first;
        continue;
      }
      of_contacts[condition.body] += push * condition.first;
      if (condition.other) of_contacts[*condition.other] += push * condition.second;
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j) add_columns("joint" + std::to_string(j), of_joints[j], all);
  for (std::size_t i = 0; contacts && i < specs.size(); ++i)
    if (movers[i]) add_columns(specs[i].name + "_contact", of_contacts[i], all);
  return all;
}

template struct Bodies<2>::System;
template struct Bodies<3>::System;

}  // namespace splashdown::rigid
