// The numbers of a shock pulse: peak, rise time, duration, change.
//
// A vector channel is read along its direction n at the peak, c = a . n: what comes before and after the pulse in another
// direction (free fall, where a = g) is no part of it. Instants as in ISO 2041 (vocabulary of vibration and shock: pulse
// rise time, duration of shock pulse) with its fractions 1/10 and 9/10 of the peak:
//
//   begin      last time before the peak at which c passes 1/10 of it upwards
//   rise time  from begin until c first reaches 9/10
//   duration   from begin until c first falls below 1/10 after the peak
//   change     integral of c over the duration: velocity change of an acceleration, impulse of a force
//
// Crossings are linear between the middles of intervals; the integral is that of the interval averages, exactly.
#pragma once

#include "apps/statistics/filters.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// The peak is sought between two times. What the record does not show (it begins or ends above 1/10) is nan. An empty
/// record has no peak.
Pulse pulse_of(const IntervalHistory& history, double from = -std::numeric_limits<double>::infinity(),
               double to = std::numeric_limits<double>::infinity());

/// The pulse of the filtered channels, for each class for which the record is long enough and, above that of structures, fine
/// enough (filters.hpp).
std::map<int, Pulse> filtered_pulses(const IntervalHistory& history);

}  // namespace splashdown::apps
