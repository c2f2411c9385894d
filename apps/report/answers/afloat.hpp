// How a body floats, for the card of answers: at rest by statics, and where its run ended.
#pragma once

#include <string>

#include "apps/report/data.hpp"

namespace splashdown::apps {

/// A tile a body that the water moves; HTML.
std::string floating_tiles(const RunData& run);

}  // namespace splashdown::apps
