#include "apps/scene/choose/round_numbers.hpp"

#include <cmath>

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

double rounded_up(double value, int digits) { return stepped(value, digits, away_from_zero); }
double rounded(double value, int digits) { return stepped(value, digits, nearest_whole); }

}  // namespace splashdown::apps
