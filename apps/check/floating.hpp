// What `check` says about a body at rest on still water.
#pragma once

#include "apps/scene/scene.hpp"
#include "rigid/body.hpp"

namespace splashdown::apps {

/// Draft, attitude and metacentric heights; in three dimensions also the curve of righting levers.
template <int d>
void print_floating(const Scene& scene, const rigid::BodySpec<d>& spec);

}  // namespace splashdown::apps
