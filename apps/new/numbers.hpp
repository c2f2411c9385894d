// Numbers of a command line: lists.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/scene/choose/round_numbers.hpp"

namespace splashdown::apps {

/// "1.2,0.4,0.3": so many finite numbers. Throws NewError with the option's name.
std::vector<double> numbers_of_list(const std::string& option, const std::string& text, std::size_t count);

}  // namespace splashdown::apps
