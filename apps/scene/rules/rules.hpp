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
  double divisor = 1;     ///< the value in force is what is given over this; both have to keep the rule

  bool operator==(const Rule&) const = default;
  bool holds(double value) const { return (low_open ? value > low : value >= low) && value <= high; }
  /// "must be positive (kg/m^3)"
  std::string law() const;
  /// " (kg/m^3)" or nothing
  std::string in_unit() const { return unit.empty() ? "" : " (" + unit + ")"; }
};

/// For outlines that are refused.
inline constexpr const char* cure_of_spline =
    "List degree + 1 control points or more, in order; degree equal ones after each other are a corner.";
inline constexpr const char* cure_of_profile = "List (r, z) from one end of the axis to the other, each point once.";

Rule any(std::string unit, std::string cure);
Rule positive(std::string unit, std::string cure);
Rule not_negative(std::string unit, std::string cure);
/// (0, 1]
Rule share(std::string cure);
/// A vector along the last axis, as TOML writes it: "[0.0, -9.81]".
std::string axis_example(int dimension, double value);
inline const char* mass_unit(int dimension) { return dimension == 2 ? "kg/m" : "kg"; }
inline const char* inertia_unit(int dimension) { return dimension == 2 ? "kg m" : "kg m^2"; }
// Of scenes [m]: with larger ones geometry in double precision has no digits left for elements, with smaller ones none
// for a tank.
inline constexpr double largest_length = 1e6, smallest_length = 1e-9;
/// A point or a displacement.
Rule place_rule(int dimension);

Rule within(double low, double high, std::string unit, std::string cure);

/// The same for a length of the mesh, which fluid.size.refine divides.
Rule refined(Rule rule, double refine);

}  // namespace splashdown::apps
