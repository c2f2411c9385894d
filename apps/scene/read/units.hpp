// What people write where a number is wanted: "2.5 kg", "300 mm".
#pragma once

#include <string>

#include "apps/scene/rules/rules.hpp"

namespace splashdown::apps {

/// How to write it: without quotes, and without its unit, of which the number in the rule's unit is proposed if it is known.
std::string cure_of_text(const std::string& text, const Rule& rule);

}  // namespace splashdown::apps
