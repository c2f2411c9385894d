// How the quantities of a campaign are distributed, as pictures on its page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace splashdown::apps {

/// A histogram a quantity, its box plots by factor, and its runs over each random axis of numbers; HTML. From study.json with an entry `campaign`.
std::string distributions(const nlohmann::ordered_json& study);

}  // namespace splashdown::apps
