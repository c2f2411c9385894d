// How summary.json has what was foreseen of a body.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/statistics/foreseen.hpp"

namespace splashdown::apps {

/// "load_by_theory" and "at_rest", of what there is.
nlohmann::ordered_json foreseen_json(const Foreseen& foreseen);

}  // namespace splashdown::apps
