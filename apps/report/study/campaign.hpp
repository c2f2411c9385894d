// What a study says as a whole, on its page: probabilities, statistics, effects and where the scatter comes from.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace splashdown::apps {

/// HTML from the entry `campaign` of study.json; empty for studies without one.
std::string campaign_section(const nlohmann::ordered_json& study);

}  // namespace splashdown::apps
