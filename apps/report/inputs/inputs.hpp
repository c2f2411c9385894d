// The last part of a run's page: hulls, effects, command and scene.
#pragma once

#include <string>

#include "apps/report/data.hpp"

namespace splashdown::apps {

/// HTML: hulls with their main dimensions, effects that are on or off and why, the command and the scene to copy.
std::string inputs_of(const RunData& run);

}  // namespace splashdown::apps
