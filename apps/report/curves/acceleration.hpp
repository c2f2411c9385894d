// Acceleration of a body or of an instrument in g: filtered as its headline number, over the raw one in grey.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {

struct AccelerationCurves {
  const Table& rows;
  std::vector<std::string> columns;  ///< of the components [m/s^2], "ax" to "az"
  Figure empty;                      ///< with its name and its axis of time
  double time_scale = 1;             ///< to the unit of that axis
  bool filters = false;              ///< whether the headline is filtered, and rows are steps
  std::string of;                    ///< "the centre of mass"
};

/// Nothing if it is zero throughout.
std::optional<Figure> acceleration_figure(const AccelerationCurves& what);

}  // namespace splashdown::apps
