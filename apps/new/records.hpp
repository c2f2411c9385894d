// What a new scene records: accelerations, the map of highest pressures, pressures of panels along the bottom.
#pragma once

#include "apps/new/plan.hpp"

namespace splashdown::apps {

/// Panels are boxes around the lowest point of the hull at equal parts of its length, in the frame of its shape.
template <int d>
void add_records(const NewOptions& options, LandingPlan& plan);

}  // namespace splashdown::apps
