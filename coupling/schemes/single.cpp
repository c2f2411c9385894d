// Steppers with one part, and the clock that all share.
#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "coupling/schemes/steppers.hpp"

namespace splashdown::coupling {

void LeapfrogClock::save(std::ostream& out) const {
  out.write(reinterpret_cast<const char*>(&previous_), sizeof previous_);
}
void LeapfrogClock::load(std::istream& in) {
  if (!in.read(reinterpret_cast<char*>(&previous_), sizeof previous_) || !(previous_ >= 0 && std::isfinite(previous_)))
    throw std::runtime_error("holds no length of the last step");
}

template <int d>
StepReport FluidOnly<d>::attempt(double dt) {
  clock_.start(dt);
  const std::size_t walls = fluid_->spec().walls.size();
  const std::vector<fluid::Twist<d>> still(walls, fluid::Twist<d>::Zero());
  auto status = fluid_->begin(clock_.kick(dt), dt, {});
  if (status.ok()) status = fluid_->solve(still);
  if (status.ok()) status = fluid_->verdict();
  return {.cause = status.cause, .passes = 1};
}

template <int d>
void FluidOnly<d>::commit() {
  const std::vector<fluid::Isometry<d>> poses(fluid_->wall_poses().begin(), fluid_->wall_poses().end());
  fluid_->commit(poses);
  clock_.commit();
}

template <int d>
void FluidOnly<d>::save(std::ostream& out) const {
  clock_.save(out);
  fluid_->save(out);
}
template <int d>
void FluidOnly<d>::load(std::istream& in) {
  clock_.load(in);
  fluid_->load(in);
}

template <int d>
StepReport BodiesOnly<d>::attempt(double dt) {
  clock_.start(dt);
  bodies_->begin(clock_.kick(dt), dt);
  const std::vector<rigid::Wrench<d>> no_load(bodies_->size(), rigid::Wrench<d>::Zero());
  const auto trial = bodies_->solve(no_load);
  trial_.assign(trial.begin(), trial.end());
  for (const auto& state : trial_)
    if (!state.velocity.allFinite()) return {.cause = "the bodies' velocities are not finite"};
  return {.cause = {}, .passes = 1};
}

template <int d>
void BodiesOnly<d>::commit() {
  bodies_->commit();
  clock_.commit();
}

template <int d>
void BodiesOnly<d>::save(std::ostream& out) const {
  clock_.save(out);
  bodies_->save(out);
}
template <int d>
void BodiesOnly<d>::load(std::istream& in) {
  clock_.load(in);
  bodies_->load(in);
}

template class FluidOnly<2>;
template class FluidOnly<3>;
template class BodiesOnly<2>;
template class BodiesOnly<3>;

}  // namespace splashdown::coupling
