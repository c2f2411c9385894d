#include "apps/statistics/energy_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace splashdown::apps {

namespace {

constexpr double calm_froude = 1e-3;  // slower than this share of sqrt(g H): at rest

}  // namespace

// The step that finds first contact may have slowed the body already: the one before counts as well.
void EnergyStatistics::add_body(std::size_t b, const BodyEnergy& body) {
  if (touched_[b] || !body.free) return;
  if (body.wet) {
    touched_[b] = 1;
    arrival_ += std::max(body.kinetic, dry_kinetic_[b]);
    hulls_ += body.immersion;
  }
  dry_kinetic_[b] = body.kinetic;
}

void EnergyStatistics::add(double time, const Ledger& ledger, const std::vector<BodyEnergy>& bodies) {
  const double kinetic = ledger.kinetic_energy;
  const double potential = ledger.potential_energy - water_.level_energy * ledger.volume_excess();
  if (!begun_) {
    first_kinetic_ = lowest_kinetic_ = kinetic;
    first_potential_ = lowest_potential_ = potential;
    begun_ = true;
  }
  dry_kinetic_.resize(bodies.size());
  touched_.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) add_body(b, bodies[b]);
  lowest_kinetic_ = std::min(lowest_kinetic_, kinetic);
  lowest_potential_ = std::min(lowest_potential_, potential);
  most_work_ = std::max(most_work_, std::abs(ledger.work_on_walls));
  most_work_of_effects_ = std::max(most_work_of_effects_, std::abs(ledger.work_of_effects));
  now_ = kinetic - first_kinetic_ + potential - first_potential_ + ledger.work_on_walls - ledger.work_of_effects;
  loss_.offer(-now_, time);
  if (gain_.offer(std::isfinite(now_) ? now_ : std::numeric_limits<double>::infinity(), time)) rise_ = loss_.time;
}

void EnergyStatistics::summarise(LedgerSummary& summary) const {
  const std::pair<double, const char*> scales[] = {
      {most_work_, "work of walls and bodies"},
      {most_work_of_effects_, "work of effects"},
      {arrival_, "kinetic energy of arriving bodies"},
      {hulls_, "pressing the hulls under"},
      {first_kinetic_ + first_potential_ - lowest_potential_, "what the water brought or let go"},
      {0.5 * calm_froude * calm_froude * water_.depth_energy, "water at rest"}};
  const auto& [scale, name] = *std::ranges::max_element(scales, {}, [](const auto& entry) { return entry.first; });
  const auto relative = [&, s = scale](double energy) { return energy > 0 ? energy / s : 0; };
  summary.energy_scale = scale;
  summary.energy_scale_from = scale > 0 ? name : "nothing";
  summary.energy_gain_joule = gain_.value;
  summary.energy_gain_time = gain_.time;
  summary.energy_gain_since = rise_;
  summary.energy_gain = relative(gain_.value);
  summary.kinetic_deficit = relative(-lowest_kinetic_);
  if (water_.hull_volume > 0) summary.volume_error_bodies = summary.volume_excess() / water_.hull_volume;
  const double least =
      water_.hull_volume > 0 ? std::min(water_.hull_volume, summary.volume_initial) : summary.volume_initial;
  summary.returned_share = least > 0 ? summary.returned / least : 0;
}

}  // namespace splashdown::apps
