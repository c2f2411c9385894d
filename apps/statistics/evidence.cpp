#include "apps/statistics/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splashdown::apps {

namespace {

constexpr double share_of_time = 0.1;  // since first contact, to each side of a peak: what a line can follow

/// Of the interval that holds a time, the nearest one outside the record.
std::size_t index_at(const IntervalHistory& history, double time) {
  const auto found = static_cast<std::size_t>(std::ranges::lower_bound(history.ends, time) - history.ends.begin());
  return std::min(found, history.ends.size() - 1);
}

/// Value at `time` of the straight line of least squares through the middles of intervals, without the one at `top`.
double line_at(const IntervalHistory& history, std::size_t first, std::size_t last, std::size_t top) {
  const double time = history.middle_of(top);
  double n = 0, t = 0, tt = 0, v = 0, tv = 0;
  for (std::size_t i = first; i <= last; ++i) {
    if (i == top) continue;
    const double at = history.middle_of(i) - time, value = history.magnitude(i);
    n += 1, t += at, tt += at * at, v += value, tv += at * value;
  }
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  const double determinant = n * tt - t * t;
  return determinant <= 0 ? v / n : (tt * v - t * tv) / determinant;
}

}  // namespace

void EvidenceStatistics::add(double begin, double end, const EvidenceReading& reading) {
  if (loads_.ends.empty()) {
    loads_.channels = static_cast<int>(2 * reading.force.size());
    loads_.begin = wet_.begin = begin;
    wet_.channels = 3;
    symmetric_ = reading.symmetric;
  }
  auto loads = reading.force;
  loads.insert(loads.end(), reading.repair.begin(), reading.repair.end());
  loads_.append(end, loads);
  wet_.append(end, std::array{reading.facets, reading.wetted, reading.speed});
  if (first_contact_ < 0 && reading.wetted > 0) first_contact_ = begin;
}

std::size_t EvidenceStatistics::step_at(double time) const { return index_at(wet_, time); }

double EvidenceStatistics::wetted_length(double time) const {
  const double wetted = wet_.values[3 * step_at(time) + 1];
  return dimension() == 2 ? wetted : std::sqrt(wetted);
}

double EvidenceStatistics::facet_size(double time) const {
  if (wet_.ends.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto i = 3 * step_at(time);
  const double facets = wet_.values[i], wetted = wet_.values[i + 1];
  if (!(facets > 0)) return std::numeric_limits<double>::quiet_NaN();
  const double triangle = std::numbers::sqrt3 / 4;  // of side 1
  return dimension() == 2 ? wetted / facets : std::sqrt(wetted / facets / triangle);
}

double EvidenceStatistics::growing(double time) const {
  const double now = wetted_length(time), before = wetted_length(0.5 * (time + std::min(time, first_contact_)));
  return now > 0 ? std::clamp(2 * (1 - before / now), 0., 1.) : 0;
}

Evidence EvidenceStatistics::at(double time) const {
  Evidence evidence;
  if (wet_.ends.empty() || time < 0) return evidence;
  const double facets = wet_.values[3 * step_at(time)], now = wetted_length(time);
  const double disc = std::sqrt(std::numbers::sqrt3 / (4 * std::numbers::pi));
  if (facets > 0) evidence.elements = dimension() == 2 ? facets / 2 : disc * std::sqrt(facets);
  if (now > 0) evidence.growing = growing(time);
  return evidence;
}

double EvidenceStatistics::step_share(const IntervalHistory& channel, double time) const {
  if (channel.ends.size() < 3 || wet_.ends.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto top = index_at(channel, time);
  const double speed = wet_.values[3 * step_at(time) + 2], h = facet_size(time);
  const double since = share_of_time * std::max(0., time - first_contact_);
  const double reach = speed > 0 && h > 0 ? std::min(h / speed, since) : 0;
  const std::size_t final = channel.ends.size() - 1, before = top == final ? 2 : 1, after = top == 0 ? 2 : 1;
  const auto first = std::min(index_at(channel, time - reach), top - std::min(top, before));
  const auto last = std::max(index_at(channel, time + reach), std::min(top + after, final));
  const double line = line_at(channel, first, last, top);
  return line > 0 ? std::abs(channel.magnitude(top) / line - 1) : std::numeric_limits<double>::infinity();
}

void EvidenceStatistics::add_shares(const double* loads, Evidence& evidence) const {
  const auto d = static_cast<std::size_t>(dimension());
  double squared = 0, along = 0, across = 0;
  for (std::size_t k = 0; k < d; ++k) {
    squared += loads[k] * loads[k];
    along += loads[k] * loads[d + k];
    if (k < symmetric_.size() && symmetric_[k]) across += loads[k] * loads[k];
  }
  if (!(squared > 0)) return;
  evidence.repair = std::abs(along) / squared;
  if (std::ranges::find(symmetric_, 1) != symmetric_.end()) evidence.sideways = std::sqrt(across / squared);
}

Evidence EvidenceStatistics::about(const Pulse& peak, const IntervalHistory& channel, std::optional<int> cfc) const {
  if (peak.time < 0 || loads_.ends.empty()) return {};
  auto evidence = at(peak.time);
  const auto n = static_cast<std::size_t>(loads_.channels);
  if (!cfc) {
    evidence.step = step_share(channel, peak.time);
    add_shares(&loads_.values[n * index_at(loads_, peak.time)], evidence);
  } else if (const auto loads = filtered(loads_, *cfc)) {
    for (auto i = step_at(peak.time - 1. / *cfc); i < step_at(peak.time); ++i)
      evidence.growing = std::max(evidence.growing, growing(wet_.middle_of(i)));
    if (const auto smooth = filtered(channel, *cfc)) {
      evidence.step = step_share(*smooth, peak.time);
      const double top = smooth->magnitude(index_at(*smooth, peak.time));
      const double quick = top > 0 ? roughness(channel, *cfc, peak.time) / top : 1;
      evidence.sampling = std::min(quick, lost_to_steps(channel, *cfc, peak.time));
    }
    add_shares(&loads->values[n * index_at(*loads, peak.time)], evidence);
  }
  return evidence;
}

Evidence EvidenceStatistics::at_pressure(double time) const {
  if (loads_.ends.empty() || time < 0) return {};
  auto evidence = at(time);
  add_shares(&loads_.values[static_cast<std::size_t>(loads_.channels) * index_at(loads_, time)], evidence);
  return evidence;
}

}  // namespace splashdown::apps
