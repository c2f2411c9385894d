// What two-level factors do to a number: main effects and pairs, by least squares.
#pragma once

#include <optional>
#include <vector>

#include "apps/study/campaign/sample.hpp"
#include "apps/study/design/fraction.hpp"

namespace splashdown::apps {

/// A run: the set of factors at their second value, and the number that was found.
struct FactorialRun {
  Factors high = 0;
  double value = 0;
};

/// Mean at the second value less mean at the first, all else being equal; of a pair: half the change of one's effect by the other.
struct Effect {
  Factors factors = 0;
  double value = 0;
  std::optional<double> standard_error;  ///< nothing: the runs leave nothing to judge it by
  std::optional<Band> band;              ///< Student's, 95 %
  std::vector<Factors> aliases;          ///< of at most two factors: their sum is what was found
};

/// Effects of one and two of `number` factors, one for each group of aliases. The standard error comes from what the effects leave
/// (replicates, higher orders), or with nothing left from the small effects by Lenth's rule (1989). Runs that are missing make it larger.
/// Empty: the runs cannot tell the effects apart.
std::vector<Effect> effects_of(const std::vector<FactorialRun>& runs, std::size_t number, const Fraction& fraction);

}  // namespace splashdown::apps
