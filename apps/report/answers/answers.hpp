// The card at the top of a run's page: what an engineer asks first. Limits, how many g and where, pressure, load, how it lies in the
// water; then what the numerics did in one quiet line.
#pragma once

#include <string>

#include "apps/report/data.hpp"

namespace splashdown::apps {

std::string answer_card(const RunData& run);  ///< HTML
std::string quiet_line(const RunData& run);   ///< HTML

}  // namespace splashdown::apps
