#include "apps/scene/read/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace splashdown::apps {
namespace {

/// One of `name` is so many of `base`.
struct Unit {
  const char *name, *base;
  double factor;
};
// BIPM, The International System of Units, 9th edition; inch, foot, pound: 1959; knot: nautical miles of 1852 m an hour.
constexpr Unit units[] = {{"mm", "m", 1e-3},
                          {"cm", "m", 1e-2},
                          {"km", "m", 1e3},
                          {"in", "m", 0.0254},
                          {"inch", "m", 0.0254},
                          {"ft", "m", 0.3048},
                          {"ms", "s", 1e-3},
                          {"us", "s", 1e-6},
                          {"min", "s", 60},
                          {"h", "s", 3600},
                          {"g", "kg", 1e-3},
                          {"t", "kg", 1e3},
                          {"lb", "kg", 0.45359237},
                          {"km/h", "m/s", 1 / 3.6},
                          {"kn", "m/s", 1852. / 3600},
                          {"knots", "m/s", 1852. / 3600},
                          {"mph", "m/s", 0.44704},
                          {"ft/s", "m/s", 0.3048},
                          {"g/cm^3", "kg/m^3", 1e3},
                          {"kg/l", "kg/m^3", 1e3},
                          {"kg mm^2", "kg m^2", 1e-6},
                          {"rad", "deg", 180 / std::numbers::pi},
                          {"rad/s", "deg/s", 180 / std::numbers::pi},
                          {"rpm", "deg/s", 6},
                          {"mPa s", "Pa s", 1e-3},
                          {"cP", "Pa s", 1e-3},
                          {"kN/m", "N/m", 1e3}};

/// Of the rule's unit, or the whole thing of what the plane has for each metre of depth.
bool same(const std::string& unit, const std::string& wanted) { return unit == wanted || unit + "/m" == wanted; }

}  // namespace

std::string cure_of_text(const std::string& text, const Rule& rule) {
  const std::string alone =
      rule.unit.empty() ? "Write the number without quotes" : "Write the number alone, in " + rule.unit;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(value)) return alone + ".";
  std::string unit(end);
  unit.erase(0, unit.find_first_not_of(' '));
  if (unit.empty() || same(unit, rule.unit)) return fmt::format("{}: {:g}.", alone, value);
  const auto known =
      std::ranges::find_if(units, [&](const Unit& u) { return unit == u.name && same(u.base, rule.unit); });
  if (known == std::end(units)) return alone + ".";
  return fmt::format("{}: {:g}.", alone, value * known->factor);
}

}  // namespace splashdown::apps
