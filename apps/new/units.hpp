// In which unit a file's lengths are: told by what the hull weighs.
//
// A unit is possible if the hull is from 0.05 to 60 m long in it, and its mean density from 20 kg/m^3, a foam model, to 2000, twice
// water's. Units differ by 2.54 at least, their volumes by 16: two or more stay possible where inches and centimetres do. Of them
// the one nearest to 200 kg/m^3 is taken, the geometric middle of both bounds, and the others are named.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/new/options.hpp"

namespace splashdown::apps {

struct LengthUnit {
  const char* name;
  const char* words;
  double metres;
  bool guessed;  ///< a file without a word about it may be in it
};
std::span<const LengthUnit> length_units();

struct UnitGuess {
  double scale = 1;  ///< metres per unit of the file
  std::vector<Assumption> told;
};

/// `extent`, `volume`: in units of the file. Throws NewError where no unit fits.
UnitGuess guessed_unit(double extent, double volume, double mass);

/// What options say: --scale, --units or neither.
UnitGuess unit_of(const NewOptions& options, double extent, double volume);

}  // namespace splashdown::apps
