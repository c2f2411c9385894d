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

StepReport FluidOnly::attempt(double dt) {
  clock_.start(dt);
  auto status = fluid_->begin({.kick = clock_.kick(dt), .dt = dt}, {});
  if (status.ok()) status = fluid_->solve({});
  const bool solved = status.ok();
  if (solved) status = fluid_->acceptable();
  return {.cause = status.cause, .passes = 1, .of_fluid = solved && !status.ok()};
}

void FluidOnly::commit() {
  fluid_->commit({});
  clock_.commit();
}

void FluidOnly::save(std::ostream& out) const {
  clock_.save(out);
  fluid_->save(out);
}
void FluidOnly::load(std::istream& in) {
  clock_.load(in);
  fluid_->load(in);
}

StepReport step_alone(StructurePart& structure, Velocities& trial) {
  trial = structure.solve(Impulse::Zero(structure.scales().size()));
  if (!trial.allFinite()) return {.cause = "the bodies' velocities are not finite"};
  return {.cause = structure.acceptable().cause, .passes = 1};
}

StepReport StructureOnly::attempt(double dt) {
  clock_.start(dt);
  structure_->begin({.kick = clock_.kick(dt), .dt = dt});
  Velocities trial;
  return step_alone(*structure_, trial);
}

void StructureOnly::commit() {
  structure_->commit();
  clock_.commit();
}

void StructureOnly::save(std::ostream& out) const {
  clock_.save(out);
  structure_->save(out);
}
void StructureOnly::load(std::istream& in) {
  clock_.load(in);
  structure_->load(in);
}

}  // namespace splashdown::coupling
