#include "rigid/participant.hpp"

#include <algorithm>
#include <cmath>

#include "rigid/shapes/mass_properties.hpp"

namespace splashdown::rigid {
namespace {

template <int d>
coupling::Velocities stacked(std::span<const BodyState<d>> states) {
  coupling::Velocities all(freedoms<d> * static_cast<Eigen::Index>(states.size()));
  Eigen::Index at = 0;
  for (const auto& state : states) all.segment<freedoms<d>>(freedoms<d> * at++) = state.velocity;
  return all;
}

}  // namespace

template <int d>
Participant<d>::Participant(std::unique_ptr<Bodies<d>> bodies) : bodies_(std::move(bodies)) {
  constexpr int m = freedoms<d>;
  const auto count = static_cast<Eigen::Index>(bodies_->size());
  scales_.setOnes(m * count);
  reach_.resize(count);
  for (Eigen::Index b = 0; b < count; ++b) {
    const auto& spec = bodies_->spec(static_cast<std::size_t>(b));
    const bool free = spec.becomes_free();
    walls_.push_back({.name = spec.name,
                      .first = m * b,
                      .count = m,
                      .answers = bodies_->answers(static_cast<std::size_t>(b)),
                      .stays = spec.motion == BodyMotion::fixed,
                      .mass = spec.mass,
                      .volume = mass_properties<d>(spec.surface).mass});
    reach_[b] = reach(spec);
    if (free)
      scales_.segment(m * b + d, rotations<d>).setConstant(std::sqrt(spec.inertia.trace() / rotations<d> / spec.mass));
    const auto& vertices = spec.surface.vertices;
    length_ = std::max(length_, (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm());
  }
}

template <int d>
double Participant<d>::stable_dt() const {
  constexpr double turn = 0.5;  // [rad]
  double dt = bodies_->stable_dt();
  for (const auto& state : bodies_->states())
    dt = std::min(dt, turn / state.velocity.template tail<rotations<d>>().norm());
  return dt;
}

template <int d>
Eigen::VectorXd Participant<d>::speeds(const coupling::Velocities& velocities) const {
  Eigen::VectorXd all(reach_.size());
  for (Eigen::Index b = 0; b < all.size(); ++b)
    all[b] = farthest_speed<d>(velocities.segment<freedoms<d>>(freedoms<d> * b), reach_[b]);
  return all;
}

template <int d>
coupling::Velocities Participant<d>::velocities() const {
  return stacked<d>(bodies_->states());
}

template <int d>
const coupling::Velocities& Participant<d>::solve(const coupling::Impulse& impulse) {
  return trial_ = stacked<d>(bodies_->solve(impulse));
}

template <int d>
const coupling::Velocities& Participant<d>::adopt(const coupling::Velocities& velocities) {
  return trial_ = stacked<d>(bodies_->adopt(velocities));
}

template <int d>
coupling::Placement Participant<d>::placement() const {
  constexpr int numbers = d * (d + 1);
  coupling::Placement all(numbers * static_cast<Eigen::Index>(bodies_->size()));
  Eigen::Index at = 0;
  for (const auto& state : bodies_->trials())
    all.segment<numbers>(numbers * at++) = state.pose.matrix().template topRows<d>().reshaped();
  return all;
}

template <int d>
void Participant<d>::see_wetted(const Eigen::VectorXd& measures) {
  bodies_->see_wetted({measures.data(), bodies_->size()});
}

template <int d>
void Participant<d>::load(std::istream& in) {
  bodies_->load(in);
  see_released();
}

template <int d>
void Participant<d>::commit() {
  bodies_->commit();
  see_released();
}

template <int d>
void Participant<d>::see_released() {
  for (std::size_t b = 0; b < walls_.size(); ++b) walls_[b].answers = bodies_->answers(b);
}

template class Participant<2>;
template class Participant<3>;

}  // namespace splashdown::rigid
