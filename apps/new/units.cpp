#include "apps/new/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/scene/rules/problems.hpp"

namespace splashdown::apps {
namespace {

constexpr double shortest = 0.05, longest = 60;                        // [m]
constexpr double lightest = 20, heaviest = 2000, usual_density = 200;  // [kg/m^3]

constexpr std::array<LengthUnit, 5> units = {{{"mm", "millimetres", 1e-3, true},
                                              {"cm", "centimetres", 1e-2, true},
                                              {"in", "inches", 0.0254, true},
                                              {"ft", "feet", 0.3048, false},
                                              {"m", "metres", 1, true}}};

struct Fit {
  const LengthUnit* unit;
  double extent, density;
};

Fit fit_of(const LengthUnit& unit, double extent, double volume, double mass) {
  return {&unit, unit.metres * extent, mass / (volume * std::pow(unit.metres, 3))};
}

std::string fit_text(const Fit& fit) {
  return fmt::format("{:.3g} m long, {:.3g} kg/m^3 in {}", fit.extent, fit.density, fit.unit->words);
}

double far_from_usual(const Fit& fit) { return std::abs(std::log(fit.density / usual_density)); }

}  // namespace

std::span<const LengthUnit> length_units() { return units; }

UnitGuess guessed_unit(double extent, double volume, double mass) {
  std::vector<Fit> possible;
  std::string all;
  for (const auto& unit : units) {
    if (!unit.guessed) continue;
    const auto fit = fit_of(unit, extent, volume, mass);
    all += (all.empty() ? "" : "; ") + fit_text(fit);
    if (fit.extent >= shortest && fit.extent <= longest && fit.density >= lightest && fit.density <= heaviest)
      possible.push_back(fit);
  }
  if (possible.empty())
    throw NewError(
        fmt::format("--mass {:g}: with no unit of the file is the hull {:g} to {:g} m long with {:g} to {:g} "
                    "kg/m^3 ({}). Correct the mass, or say the unit with --units {}",
                    mass, shortest, longest, lightest, heaviest, all, "mm, cm, in, ft or m"));
  std::ranges::sort(possible, {}, far_from_usual);
  const auto& best = possible.front();
  UnitGuess guess{best.unit->metres, {}};
  std::string others;
  for (std::size_t i = 1; i < possible.size(); ++i)
    others += fmt::format("{}{} (--units {})", i > 1 ? ", or " : "", fit_text(possible[i]), possible[i].unit->name);
  guess.told.push_back(
      {"units",
       others.empty()
           ? fmt::format("the file is in {}, the only unit in which extent and mass go together: {:.3g} m, "
                         "mean density {:.3g} kg/m^3",
                         best.unit->words, best.extent, best.density)
           : fmt::format("NOT CERTAIN: the file is taken to be in {}: {:.3g} m, mean density {:.3g} kg/m^3. It "
                         "could also be {}",
                         best.unit->words, best.extent, best.density, others)});
  return guess;
}

UnitGuess unit_of(const NewOptions& options, double extent, double volume) {
  if (options.scale && !options.units.empty())
    throw NewError("--scale and --units say the same thing. Leave one of them out");
  double scale = 0;
  std::string said;
  if (options.scale) {
    scale = *options.scale;
    said = fmt::format("--scale {:g}", scale);
  } else if (!options.units.empty()) {
    const auto unit = std::ranges::find(units, options.units, &LengthUnit::name);
    if (unit == units.end()) throw NewError(fmt::format("--units {}: must be mm, cm, in, ft or m", options.units));
    scale = unit->metres;
    said = "--units " + options.units;
  } else {
    return guessed_unit(extent, volume, *options.mass);
  }
  return {scale,
          {{"units", fmt::format("{}: the hull is {:.3g} m long, mean density {:.3g} kg/m^3", said, scale * extent,
                                 *options.mass / (volume * scale * scale * scale))}}};
}

}  // namespace splashdown::apps
