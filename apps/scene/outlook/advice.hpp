// What theory says of an effect in a scene before it is run.
//
// Estimates are orders of magnitude from closed formulas, each with its source; they are taken to be right within `trust`, and
// are held against `least_change`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

/// A dimensionless number, or one with a unit, of the scene.
struct AdviceNumber {
  std::string name;
  double value = 0;
  std::string unit = "-";
};

enum class Advised { off, doubtful, on };
/// "off", "doubtful", "on"
const char* word(Advised advised);

/// Relative changes that the effect makes; absent: there is no such thing in the scene.
struct ExpectedChange {
  std::optional<double> peak;    ///< of the peak load of the first impact
  std::optional<double> motion;  ///< of speeds and places at the end of the run
};

struct Advice {
  Advised advised = Advised::off;
  ExpectedChange change;
  std::vector<AdviceNumber> numbers;
  std::string reason;            ///< a sentence without a full stop
  std::string source;            ///< where the estimate comes from; empty: there is none
  std::vector<std::string> set;  ///< --set arguments that add it, with values; empty: there is no way to
};

inline constexpr double least_change = 0.01;  ///< a change below it is not looked for
inline constexpr double trust = 3;            ///< factor within which an estimate is right

/// On where the change is above `least_change` even if it is overestimated, off where it is below even if it is underestimated.
Advised judged(double change);
/// The worse of both.
Advised judged(const ExpectedChange& change);

}  // namespace splashdown::apps
