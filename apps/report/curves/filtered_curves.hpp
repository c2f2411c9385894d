// Curves of a body through the filter that its headline numbers have, from the rows of bodies.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/report/data.hpp"

namespace splashdown::apps {

struct FilteredCurves {
  std::vector<double> t;                    ///< [s]
  std::vector<std::vector<double>> values;  ///< a component each
};

/// The components of a vector. A row stands for the time that is nearer to it than to any other. Nothing where the record is shorter
/// than 1/CFC or the rows are not what the program writes.
std::optional<FilteredCurves> filtered_curves(const Table& rows, const std::vector<std::string>& columns, int cfc);

}  // namespace splashdown::apps
