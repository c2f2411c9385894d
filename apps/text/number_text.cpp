#include "apps/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace splashdown::apps {

namespace {

std::string superscript(int exponent) {
  constexpr std::array raised = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += raised[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

MetricPrefix prefix_of(double value) {
  constexpr MetricPrefix prefixes[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "u"}};
  // 0.9995 and more round to a thousand of the next smaller prefix.
  for (const auto& prefix : prefixes)
    if (std::isfinite(value) && std::abs(value) >= 0.9995 * prefix.factor) return prefix;
  return {1, ""};
}

std::string with_unit(double value, const std::string& unit) {
  const auto prefix = prefix_of(value);
  return fmt::format("{:.4g} {}{}", value / prefix.factor, prefix.name, unit);
}

std::string clock_text(double wall) {
  const double day = 86400;
  if (!(wall < 100 * day)) return fmt::format("{:.2g} days", wall / day);
  const long whole = static_cast<long>(wall + 0.5);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

Unit si_unit(double largest, const std::string& unit) {
  largest = std::abs(largest);
  if (largest >= 1e9) return {1e-9, "G" + unit};
  if (largest >= 1e6) return {1e-6, "M" + unit};
  if (largest >= 1e3) return {1e-3, "k" + unit};
  if (largest >= 0.1 || largest == 0 || !std::isfinite(largest)) return {1, unit};
  return {1e3, "m" + unit};
}

Unit time_unit(double end_time) { return end_time < 0.5 ? Unit{1e3, "ms"} : Unit{1, "s"}; }

std::string force_unit(int dimension) { return dimension == 2 ? "N/m" : "N"; }
std::string moment_unit(int dimension) { return dimension == 2 ? "N m/m" : "N m"; }
std::string energy_unit(int dimension) { return dimension == 2 ? "J/m" : "J"; }

std::string digits(double value, int count) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  // Of the rounded value: 9.9996 is "10.00", not "10.000".
  const double rounded = std::abs(value) * (1 + 0.5 * std::pow(10.0, -count));
  const int magnitude = static_cast<int>(std::floor(std::log10(rounded)));
  const std::string sign = value < 0 ? "−" : "";
  if (magnitude >= -4 && magnitude <= 6)
    return sign + fmt::format("{:.{}f}", std::abs(value), std::max(0, count - 1 - magnitude));
  return sign +
         fmt::format("{:.{}f}·10{}", std::abs(value) * std::pow(10.0, -magnitude), count - 1, superscript(magnitude));
}

std::string digits_with_unit(double value, const std::string& unit, int count) {
  const auto [scale, name] = si_unit(value, unit);
  return digits(value * scale, count) + " " + name;
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  if (seconds < 1) return digits(seconds * 1e3, 3) + " ms";
  if (seconds < 120) return digits(seconds, 3) + " s";
  const auto minutes = static_cast<long>(std::lround(seconds / 60));
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

std::string count_text(double count) { return std::isfinite(count) ? fmt::format("{:.0f}", count) : "–"; }

std::string percent(double share) { return digits(100 * share, 2) + " %"; }

}  // namespace splashdown::apps
