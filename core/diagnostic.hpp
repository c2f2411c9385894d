// Numbers that parts of a simulation say about themselves.
#pragma once

#include <string>
#include <utility>

namespace splashdown {

/// Name and value of a number worth recording.
using Diagnostic = std::pair<std::string, double>;

}  // namespace splashdown
