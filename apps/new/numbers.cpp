#include "apps/new/numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "apps/new/options.hpp"

namespace splashdown::apps {
namespace {

/// A whole number of such steps, as near to its decimals as can be: divided, not multiplied, below 1.
double stepped(double value, int digits, double (*whole)(double)) {
  if (value == 0 || !std::isfinite(value)) return value;
  const int place = static_cast<int>(std::floor(std::log10(std::abs(value)))) - digits + 1;
  const double step = std::pow(10., std::abs(place));
  return place < 0 ? whole(value * step) / step : whole(value / step) * step;
}

double away_from_zero(double value) {
  const double written_digits = 1e-9;  // what is a whole number but for roundoff stays
  return std::copysign(std::ceil(std::abs(value) * (1 - written_digits)), value);
}

double nearest_whole(double value) { return std::round(value); }

}  // namespace

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

double rounded_up(double value, int digits) { return stepped(value, digits, away_from_zero); }
double rounded(double value, int digits) { return stepped(value, digits, nearest_whole); }

}  // namespace splashdown::apps
