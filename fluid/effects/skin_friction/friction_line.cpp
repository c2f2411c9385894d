#include "fluid/effects/skin_friction/friction_line.hpp"

#include <cmath>

namespace splashdown::fluid {
namespace {

double ittc1957(double reynolds) {
  constexpr double lowest = 1e4;  // its pole is at 100
  const double digits = std::log10(std::fmax(reynolds, lowest)) - 2, line = 0.075 / (digits * digits);
  return reynolds < lowest ? line * std::sqrt(lowest / reynolds) : line;
}

// Schlichting, Boundary-Layer Theory, 7th ed., equations 7.34, 21.11 to 21.16a.
double flat_plate(double reynolds) {
  constexpr double turbulent = 5e5, logarithmic = 1e7, start = 1742;
  if (reynolds < turbulent) return 1.32823 / std::sqrt(reynolds);
  const auto power = [](double re) { return 0.074 / std::pow(re, 0.2); };
  if (reynolds < logarithmic) return power(reynolds) - start / reynolds;
  const auto line = [](double re) { return 0.455 / std::pow(std::log10(re), 2.58); };
  return line(reynolds) - (start + logarithmic * (line(logarithmic) - power(logarithmic))) / reynolds;
}

}  // namespace

double friction_coefficient(FrictionLine line, double reynolds) {
  return line == FrictionLine::ittc1957 ? ittc1957(reynolds) : flat_plate(reynolds);
}

}  // namespace splashdown::fluid
