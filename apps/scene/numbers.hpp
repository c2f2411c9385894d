// The numbers of a run of this scene that have a name: "wedge.peak_force_cfc60", "seat.peak_g".
#pragma once

#include <vector>

#include "apps/scene/limit.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Peaks, impulses and depths of the bodies, then what the records measure. `peak_g` and `peak_force` are of CFC 60, of structures
/// as a whole (SAE J211-1), raw where a run is too short for that class.
std::vector<NamedNumber> numbers_of(const Scene& scene);

}  // namespace splashdown::apps
