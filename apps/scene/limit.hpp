// Limits that a scene asks about, and the numbers of a run that have a name of their own.
//
// A limit is a question about a number of the run: is it above, or below, a value? Its quantity is an expression
// (apps/quantity/expression.hpp) in such names: "seat.peak_g", "bow.peak_pressure - stern.peak_pressure".
// What is answered: apps/statistics/verdict/limits.hpp.
#pragma once

#include <string>
#include <vector>

namespace splashdown::apps {

struct Limit {
  std::string name;      ///< its key in summary.json
  std::string quantity;  ///< expression
  std::string unit;      ///< of the quantity
  bool above = true;     ///< asks whether the quantity is above `value`; if not, whether it is below
  double value = 0;      ///< [unit]
};

/// A number of summary.json.
struct NamedNumber {
  std::string name, unit;
  std::vector<std::string> paths;  ///< in summary.json; the first that a run has counts
  std::string body;                ///< that it is of; empty: of a place
  bool peak = true;                ///< the largest so far: as a run goes on it never falls
};

}  // namespace splashdown::apps
