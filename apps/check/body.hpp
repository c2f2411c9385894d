// What `check` says about a body: mass properties, where it touches the water, how it floats.
#pragma once

#include "apps/check/rest.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

template <int d>
void print_body(const Scene& scene, std::size_t number, const std::optional<Resting<d>>& resting);

}  // namespace splashdown::apps
