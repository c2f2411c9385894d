// What theory and statics say of a scene's bodies, for the summary of its run.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "apps/scene/scene.hpp"
#include "apps/statistics/foreseen.hpp"

namespace splashdown::apps {

/// By body. Nothing that fails here stops a run: what cannot be computed is left out.
template <int d>
std::map<std::string, Foreseen> foreseen(const Scene& scene);

template <int d>
std::optional<StillWater> still_water(const Scene& scene);

}  // namespace splashdown::apps
