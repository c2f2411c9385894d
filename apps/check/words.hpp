// How `check` writes what it says.
#pragma once

#include <string>

namespace splashdown::apps {

/// A line of a section: what, and its value.
void row(const std::string& head, const std::string& text);
/// Two significant digits, without an exponent where people do not want one.
std::string rough(double value);

/// Units of masses, forces and moments of inertia: a plane scene's are per metre of depth.
template <int d>
struct Units;
template <>
struct Units<2> {
  static constexpr const char *volume = "m^2", *volume_name = "area", *mass = "kg/m", *inertia = "kg m";
};
template <>
struct Units<3> {
  static constexpr const char *volume = "m^3", *volume_name = "volume", *mass = "kg", *inertia = "kg m^2";
};

}  // namespace splashdown::apps
