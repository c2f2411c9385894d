// What `check` says about a body at rest on still water.
#pragma once

#include "apps/check/rest.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Draft and attitude; of one that nothing holds also metacentric heights, and in three dimensions the curve of righting levers.
template <int d>
void print_floating(const Scene& scene, std::size_t body, const Resting<d>& resting);

}  // namespace splashdown::apps
