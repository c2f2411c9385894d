// Error texts put together from words and values.
#pragma once

#include <sstream>
#include <string>

namespace splashdown::rigid {

/// All parts one after the other, as streams write them.
template <class... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace splashdown::rigid
