// Whether a load still grows when its record ends: what is largest then is the load of that instant and no peak.
//
// The time since first contact is cut into 20 windows, fewer where steps are long. The load rises if its mean over the last
// window is larger than over each one before, by more than 1 %, and if its largest step is in the last two. Near a peak, where a load
// is 1 - k (1 - t/t_peak)^2, a record that ends at less than 1 % a window is within k/400 of it.
#pragma once

#include "apps/statistics/filters.hpp"

namespace splashdown::apps {

/// Of the magnitude of a vector channel between two times.
bool rises_at_end(const IntervalHistory& history, double from, double to);

}  // namespace splashdown::apps
