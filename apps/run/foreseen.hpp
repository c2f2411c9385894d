// What theory and statics say of a scene's bodies, for the summary of its run.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"
#include "apps/statistics/foreseen.hpp"

namespace splashdown::apps {

struct Foresight {
  std::map<std::string, Foreseen> bodies;  ///< by name
  std::vector<std::string> untold;         ///< what could not be computed, and why
};
/// Nothing that fails here stops a run: what cannot be computed is left out, and said.
template <int d>
Foresight foreseen(const Scene& scene);

template <int d>
std::optional<StillWater> still_water(const Scene& scene);

}  // namespace splashdown::apps
