// What all couplings of a fluid with a structure share.
#include <algorithm>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "core/stopwatch.hpp"
#include "coupling/schemes/steppers.hpp"

namespace splashdown::coupling {

Step Coupled::begin_structure(double dt) {
  clock_.start(dt);
  const Step step{.kick = clock_.kick(dt), .dt = dt};
  const Stopwatch moving(structure_seconds_), coupling(coupling_seconds_);
  structure_->begin(step);
  return step;
}

void Coupled::judge(StepReport& report) const {
  if (report.ok()) report.cause = structure_->acceptable().cause;
  if (!report.ok()) return;
  report.cause = fluid_->acceptable().cause;
  report.of_fluid = !report.ok();
}

double Coupled::fluid_seconds() const {
  double sum = 0;
  for (const auto& phase : fluid_->phase_seconds()) sum += phase.second;
  return sum;
}

double Coupled::stable_dt() const { return std::min(fluid_->stable_dt(), structure_->stable_dt()); }

double Coupled::still(double dt) const {
  constexpr double lengths = 1e-9;
  return lengths * structure_->length() / dt;
}

StepReport Coupled::attempt(double dt) {
  dt_ = dt;
  return waits_ ? move_structure_alone(dt) : couple(dt);
}

StepReport Coupled::move_structure_alone(double dt) {
  begin_structure(dt);
  const Stopwatch moving(structure_seconds_), coupling(coupling_seconds_);
  return step_alone(*structure_, alone_);
}

void Coupled::commit() {
  if (waits_) {
    fluid_->wait(dt_, structure_->placement(), alone_);
  } else {
    remember();
    structure_->see_wetted(fluid_->solution().wetted);
    fluid_->commit(structure_->placement());
  }
  structure_->commit();
  clock_.commit();
  if (may_wait_) waits_ = fluid_->rests(structure_->walls(), structure_->speeds(structure_->velocities()));
}

std::vector<std::pair<std::string, double>> Coupled::phase_seconds() const {
  auto phases = fluid_->phase_seconds();
  phases.emplace_back(structure_->name(), structure_seconds_);
  phases.emplace_back("coupling", std::max(0.0, coupling_seconds_ - structure_seconds_));
  return phases;
}

void Coupled::save(std::ostream& out) const {
  out.put(waits_ ? 1 : 0);
  clock_.save(out);
  fluid_->save(out);
  structure_->save(out);
}
void Coupled::load(std::istream& in) {
  const int waits = in.get();
  if (waits != 0 && waits != 1) throw std::runtime_error("does not say whether the water waits");
  waits_ = waits == 1;
  clock_.load(in);
  fluid_->load(in);
  structure_->load(in);
}

}  // namespace splashdown::coupling
