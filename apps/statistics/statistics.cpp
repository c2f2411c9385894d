#include "apps/statistics/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "apps/statistics/pulse.hpp"
#include "apps/statistics/rise.hpp"

namespace splashdown::apps {

namespace {

void offer_if_finite(Peak& peak, double value, double time) {
  if (std::isfinite(value)) peak.offer(value, time);
}

void update(RangeCount& range, std::size_t count, bool first) {
  const auto value = static_cast<long>(count);
  if (first) range = {value, value, value};
  range.max = std::max(range.max, value);
  range.final = value;
}

}  // namespace

void PulseStatistics::add(const Kick& kick, std::span<const double> value) {
  double squared = 0;
  for (const double v : value) squared += v * v;
  offer_if_finite(raw_, std::sqrt(squared), kick.time);
  if (history_.ends.empty()) {
    history_.channels = static_cast<int>(value.size());
    history_.begin = kick.begin;
  }
  history_.append(kick.end, value);
}

PulseSummary PulseStatistics::summary(double unit) const {
  PulseSummary summary{pulse_of(history_), filtered_pulses(history_)};
  static_cast<Peak&>(summary.raw) = raw_;  // its time is t_n, not the middle of the kick
  summary.raw.value /= unit;
  for (auto& [cfc, pulse] : summary.cfc) pulse.value /= unit;
  return summary;
}

namespace {

/// Of the headline's class where the record has it: single steps hide neither a peak nor that there is none.
bool rising(const IntervalHistory& force, double first_contact) {
  const double end = force.ends.back();
  const auto smooth = filtered(force, structures_class);
  return rises_at_end(smooth ? *smooth : force, first_contact, end);
}

}  // namespace

PulseGrades evidence_of(const EvidenceStatistics& steps, const PulseSummary& pulses, const PulseStatistics& channel) {
  PulseGrades grades;
  if (pulses.raw.time >= 0) grades.raw.emplace().evidence = steps.about(pulses.raw, channel.history(), {});
  for (const auto& [cfc, pulse] : pulses.cfc) grades.cfc[cfc].evidence = steps.about(pulse, channel.history(), cfc);
  return grades;
}

template <int d>
void BodyStatistics<d>::add(const Kick& kick, const BodyReading<d>& reading) {
  acceleration_.add(kick, {reading.acceleration.data(), static_cast<std::size_t>(d)});
  const Wrench<d> total = reading.load.total();
  for (int k = 0; k < d; ++k) {
    impulse_[static_cast<std::size_t>(k)] += total(k) * kick.length();
    impulse_repair_[static_cast<std::size_t>(k)] += reading.load.repair(k) * kick.length();
  }
  to_and_fro_ += total.template head<d>().norm() * kick.length();
  offer_if_finite(submergence_, reading.submergence, kick.time);
  offer_if_finite(wetted_, reading.load.wetted, kick.time);
  force_.add(kick, {total.data(), static_cast<std::size_t>(d)});
  const auto force = total.template head<d>();
  const auto repair = reading.load.repair.template head<d>();
  evidence_.add(kick.begin, kick.end,
                {{force.begin(), force.end()},
                 {repair.begin(), repair.end()},
                 reading.facets,
                 reading.load.wetted,
                 reading.velocity.template head<d>().norm(),
                 reading.symmetric});
  mass_ = reading.free ? reading.mass : 0;
  const auto& velocity = reading.velocity;
  fastest_ = std::max(fastest_, velocity.template head<d>().norm() +
                                    reading.extent.reach * velocity.template tail<rotations<d>>().norm());
  landing_.add(kick.time, {reading.rotation, reading.velocity, reading.load.wetted, reading.free, -reading.submergence},
               reading.extent);
}

template <int d>
BodySummary BodyStatistics<d>::summary() const {
  BodySummary summary;
  summary.acceleration = acceleration_.summary(standard_gravity);
  summary.force = force_.summary();
  summary.impulse.assign(impulse_.begin(), impulse_.end());
  summary.impulse_repair.assign(impulse_repair_.begin(), impulse_repair_.end());
  summary.impulse_to_and_fro = to_and_fro_;
  summary.submergence = submergence_;
  summary.wetted = wetted_;
  summary.landing = landing_.summary();
  if (summary.landing.first_contact >= 0) summary.rising = rising(force_.history(), summary.landing.first_contact);
  summary.fastest = fastest_;
  summary.force_grades = evidence_of(evidence_, summary.force, force_);
  if (!moves_freely()) return summary;
  summary.acceleration_grades = evidence_of(evidence_, summary.acceleration, acceleration_);
  const double inertia = mass_ * standard_gravity * summary.acceleration.raw.value;
  if (summary.force.raw.value > 0) summary.inertial = std::min(1., inertia / summary.force.raw.value);
  return summary;
}

void RunStatistics::add_step(int passes) {
  ++steps;
  passes_sum += passes;
  passes_max = std::max(passes_max, passes);
}

void RunStatistics::add_mesh(std::size_t node_count, std::size_t element_count) {
  update(nodes, node_count, !mesh_seen_);
  update(elements, element_count, !mesh_seen_);
  mesh_seen_ = true;
}

LedgerSummary summary_of(const Ledger& ledger) {
  LedgerSummary summary;
  summary.volume_initial = ledger.volume_initial;
  summary.volume_of_effects = ledger.volume_of_effects;
  summary.volume_final = ledger.volume;
  // Spray has left the mesh but not the world.
  if (ledger.volume_initial > 0) summary.volume_error = ledger.volume_excess() / ledger.volume_initial;
  summary.time_integration = ledger.time_integration;
  summary.remesh_created = ledger.remesh_created;
  summary.remesh_deleted = ledger.remesh_deleted;
  summary.returned = ledger.returned;
  summary.spray = ledger.spray;
  summary.kinetic_energy = ledger.kinetic_energy;
  summary.potential_energy = ledger.potential_energy;
  summary.energy_remesh = ledger.energy_remesh;
  summary.energy_repair = ledger.energy_repair;
  summary.work_on_walls = ledger.work_on_walls;
  return summary;
}

template class BodyStatistics<2>;
template class BodyStatistics<3>;

}  // namespace splashdown::apps
