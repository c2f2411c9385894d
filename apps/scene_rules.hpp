// What a number in a scene may be: an interval, with its unit and a cure for those who step outside.
#pragma once

#include <limits>
#include <string>

namespace splashdown::apps {

struct Rule {
  std::string unit;  ///< empty: a pure number
  std::string cure;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  ///< `low` itself is not allowed

  bool holds(double value) const { return (low_open ? value > low : value >= low) && value <= high; }
  /// "must be positive (kg/m^3)"
  std::string law() const;
  /// " (kg/m^3)" or nothing
  std::string in_unit() const { return unit.empty() ? "" : " (" + unit + ")"; }
};

Rule any(std::string unit, std::string cure);
Rule positive(std::string unit, std::string cure);
Rule not_negative(std::string unit, std::string cure);
/// (0, 1]
Rule share(std::string cure);
Rule within(double low, double high, std::string unit, std::string cure);

}  // namespace splashdown::apps
