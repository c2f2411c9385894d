// What a scene asks for, to be held against what its run has.
#pragma once

#include "apps/scene/scene.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

Expectations expectations_of(const Scene& scene);

}  // namespace splashdown::apps
