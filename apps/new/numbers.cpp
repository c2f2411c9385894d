#include "apps/new/numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "apps/new/options.hpp"

namespace splashdown::apps {

std::vector<double> numbers_of_list(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  bool good = true;
  while (good) {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    good = end != at && std::isfinite(numbers.back()) && (*end == ',' || *end == '\0');
    if (!good || *end == '\0') break;
    at = end + 1;
  }
  if (!good || numbers.size() != count)
    throw NewError(fmt::format("{} {}: must be {} numbers with commas between them. Use e.g. {} {}", option, text,
                               count, option, count == 3 ? "0.5,0,0.1" : "0.5,0.1"));
  return numbers;
}

}  // namespace splashdown::apps
