// What `check` says about a body: mass properties, where it touches the water, how it floats.
#pragma once

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

template <int d>
void print_body(const Scene& scene, const Body& body);

}  // namespace splashdown::apps
