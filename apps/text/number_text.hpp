// Numbers as people read them: digits, prefixes, units, times. A terminal gets plain characters, a page a minus sign, powers of ten
// and a fixed number of digits.
#pragma once

#include <string>

namespace splashdown::apps {

/// (value / factor) has this prefix before its unit.
struct MetricPrefix {
  double factor;
  const char* name;
};
/// G to u, so that the number before it is from 1 to 1000; none for what is smaller, zero or not a number.
MetricPrefix prefix_of(double value);

/// Up to four digits and a metric prefix, as a terminal shows it: 26745.8 N/m -> "26.75 kN/m", 0.014872 s -> "14.87 ms".
std::string with_unit(double value, const std::string& unit);

/// "0:07", "12:30", "3:05:00"
std::string clock_text(double seconds);

/// value * scale is in `unit`.
struct Unit {
  double scale = 1;
  std::string unit;
};

/// Picks the prefix (none, k, M, G; or m for small values) that suits `largest`.
Unit si_unit(double largest, const std::string& unit);
Unit time_unit(double end_time);
std::string force_unit(int dimension);   ///< N/m or N
std::string moment_unit(int dimension);  ///< N m/m or N m
std::string energy_unit(int dimension);  ///< J/m or J

/// `count` significant digits, with a power of ten outside 1e-4 to 1e7; "–" for nan.
std::string digits(double value, int count = 4);
/// `count` significant digits and an SI prefix from m to G, as a page shows it: 0.05 m -> "50.00 mm".
std::string digits_with_unit(double value, const std::string& unit, int count = 4);
std::string seconds_text(double seconds);  ///< "840 ms", "13.2 s", "2 h 05 min"

std::string percent(double share);
std::string count_text(double count);

}  // namespace splashdown::apps
