// What all couplings of a fluid with bodies share.
#include <algorithm>

#include "coupling/schemes/steppers.hpp"
#include "coupling/stopwatch.hpp"

namespace splashdown::coupling {

template <int d>
void Coupled<d>::begin_bodies(double dt) {
  clock_.start(dt);
  kick_ = clock_.kick(dt);
  const Stopwatch moving(rigid_seconds_), coupling(coupling_seconds_);
  bodies_->begin(kick_, dt);
}

template <int d>
std::vector<fluid::Twist<d>> Coupled<d>::of_walls(const std::vector<fluid::Twist<d>>& bodies) const {
  std::vector<fluid::Twist<d>> all = bodies;
  all.resize(fluid_->spec().walls.size(), fluid::Twist<d>::Zero());
  return all;
}

template <int d>
std::vector<rigid::Wrench<d>> Coupled<d>::total_loads() const {
  std::vector<rigid::Wrench<d>> loads;
  for (std::size_t b = 0; b < bodies_->size(); ++b) loads.push_back(fluid_->loads()[b].total());
  return loads;
}

template <int d>
double Coupled<d>::fluid_seconds() const {
  double sum = 0;
  for (const auto& phase : fluid_->phase_seconds()) sum += phase.second;
  return sum;
}

template <int d>
double Coupled<d>::stable_dt() const {
  constexpr double turn = 0.5;  // [rad]
  double dt = fluid_->stable_dt();
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    const double spin = bodies_->state(b).velocity.template tail<fluid::rotations<d>>().norm();
    if (spin * dt > turn) dt = turn / spin;
  }
  return dt;
}

template <int d>
double Coupled<d>::still(double dt) const {
  constexpr double lengths = 1e-9;
  double longest = 0;
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    const auto& vertices = bodies_->spec(b).surface.vertices;
    longest = std::max(longest, (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm());
  }
  return lengths * longest / dt;
}

template <int d>
void Coupled<d>::commit() {
  std::vector<fluid::Isometry<d>> poses(fluid_->wall_poses().begin(), fluid_->wall_poses().end());
  for (std::size_t b = 0; b < trial_.size(); ++b) poses[b] = trial_[b].pose;
  fluid_->commit(poses);
  bodies_->commit();
  clock_.commit();
}

template <int d>
std::vector<std::pair<std::string, double>> Coupled<d>::phase_seconds() const {
  auto phases = fluid_->phase_seconds();
  phases.emplace_back("rigid", rigid_seconds_);
  phases.emplace_back("coupling", std::max(0.0, coupling_seconds_ - rigid_seconds_));
  return phases;
}

template <int d>
void Coupled<d>::save(std::ostream& out) const {
  clock_.save(out);
  fluid_->save(out);
  bodies_->save(out);
}
template <int d>
void Coupled<d>::load(std::istream& in) {
  clock_.load(in);
  fluid_->load(in);
  bodies_->load(in);
}

template class Coupled<2>;
template class Coupled<3>;

}  // namespace splashdown::coupling
