// What lengths of shapes have to be. Internal to the rigid-body room.
#pragma once

#include <cmath>
#include <stdexcept>

#include "rigid/message.hpp"

namespace splashdown::rigid {

/// Throws std::invalid_argument naming shape, length and value unless the value is positive and finite.
inline void require_positive(const char* shape, const char* what, double value) {
  if (!(value > 0 && std::isfinite(value)))
    throw std::invalid_argument(message(shape, ": ", what, " is ", value, "; it must be positive"));
}

}  // namespace splashdown::rigid
