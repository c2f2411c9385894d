#include "elastic/walls/wall.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "elastic/stored_field.hpp"

namespace splashdown::elastic {

template <int d>
ElasticWall<d>::ElasticWall(const Solid<d>& solid, Dynamics dynamics)
    : solid_(solid), dynamics_(std::move(dynamics)), boundary_(boundary_of<d>(solid.mesh())) {
  u_ = s_ = a_ = s_next_ = Field::Zero(solid.size());
  mixing_ = Mixing(d * static_cast<Eigen::Index>(boundary_.nodes.size()));
}

template <int d>
Eigen::VectorXd ElasticWall<d>::at_boundary(const Field& field) const {
  Eigen::VectorXd all(d * static_cast<Eigen::Index>(boundary_.nodes.size()));
  Eigen::Index at = 0;
  for (const int a : boundary_.nodes) all.segment<d>(d * at++) = field.segment<d>(d * a);
  return all;
}

template <int d>
Field ElasticWall<d>::spread(const Eigen::VectorXd& impulse) const {
  Field all = Field::Zero(solid_.size());
  Eigen::Index at = 0;
  for (const int a : boundary_.nodes) all.segment<d>(d * a) = impulse.segment<d>(d * at++);
  return all;
}

template <int d>
const Eigen::VectorXd& ElasticWall<d>::tried(const Status& status) {
  status_ = begun_.ok() ? status : begun_;
  return trial_ = at_boundary(s_next_);
}

template <int d>
void ElasticWall<d>::begin(double t, double kick, double dt) {
  dt_ = dt;
  kick_ = kick;
  load_ = kick * dynamics_.load(t);
  if (dynamics_.drive) drive_ = dynamics_.drive(t + dt / 2);
  begun_ = {};
  mixing_.forget();
  strayed_next_ = strayed_;
  prepare();
  free_ = solve(Eigen::VectorXd::Zero(d * static_cast<Eigen::Index>(boundary_.nodes.size())));
  begun_ = status_;
  modal_ = linearised();
}

template <int d>
const Eigen::VectorXd& ElasticWall<d>::solve(const Eigen::VectorXd& impulse) {
  impulse_ = impulse;
  return asked_ = tried(move(impulse));
}

template <int d>
const Eigen::VectorXd& ElasticWall<d>::adopt(const Eigen::VectorXd& velocities) {
  asked_ = velocities;
  return tried(follow(velocities));
}

template <int d>
bool ElasticWall<d>::update(const Eigen::VectorXd& impulse, double tolerance) {
  if (!status_.ok() || !impulse.allFinite()) return false;  // it is refused
  impulse_ = impulse;
  auto all = renewed(impulse);
  status_ = all.status;
  if (!status_.ok()) return false;
  const double change = (all.velocities - asked_).norm();
  constexpr double most_stray = 0.01;  // at most, of its velocities: more where it turns by a fiftieth of a radian
  const double speed = trial_.norm() + free_.norm();
  if (change <= tolerance * speed) return false;
  constexpr double most_work = 5e-3;  // of its energy, that the fluid has not booked, in all steps together
  strayed_next_ = strayed_ + impulse.dot(all.velocities - asked_);
  if (change <= std::min(stray(), most_stray * trial_.norm()) && std::abs(strayed_next_) <= most_work * trial_energy())
    return false;
  strayed_next_ = strayed_;
  free_ = std::move(all.free);
  return true;
}

/// The tangent of the begun step tells how far the last trial is from the one under the impulse. Changes are mixed where a body
/// bends so far that this tangent is wrong.
template <int d>
typename ElasticWall<d>::Renewed ElasticWall<d>::renewed(const Eigen::VectorXd& impulse) {
  const Eigen::LDLT<Eigen::MatrixXd> inertia(modal_.inertia);
  const Eigen::VectorXd obeyed = implied();
  return {.status = {},
          .velocities = trial_ + modal_.modes * inertia.solve(modal_.modes.transpose() * impulse - obeyed),
          .free = free_ + mixing_.way(trial_ - modal_.modes * inertia.solve(obeyed) - free_)};
}

template <int d>
Status ElasticWall<d>::acceptable() const {
  if (!status_.ok()) return status_;
  if (!s_next_.allFinite()) return {"the solid's velocities are not finite"};
  if (!(solid_.least_volume_ratio(u_ + dt_ * s_next_) > 0)) return {"an element of the solid turns over"};
  return {};
}

template <int d>
void ElasticWall<d>::commit() {
  dissipated_ += damping_work();
  if (drive_.size() > 0) driven_ += drive_work(spread(impulse_));
  accept();
  strayed_ = strayed_next_;
  a_ = (s_next_ - s_) / kick_;
  s_ = s_next_;
}

template <int d>
Eigen::VectorXd ElasticWall<d>::placement() const {
  return boundary_.surface.vertices.reshaped() + at_boundary(u_ + dt_ * s_next_);
}

template <int d>
void ElasticWall<d>::save(std::ostream& out) const {
  write_field(out, s_);
  write_field(out, a_);
  write_field(out, Eigen::Vector3d(dissipated_, driven_, strayed_));
  write(out);
}

template <int d>
void ElasticWall<d>::load(std::istream& in) {
  read_field(in, s_);
  read_field(in, a_);
  Field energies(3);
  read_field(in, energies);
  dissipated_ = energies[0];
  driven_ = energies[1];
  strayed_ = energies[2];
  read(in);
}

template class ElasticWall<2>;
template class ElasticWall<3>;

}  // namespace splashdown::elastic
