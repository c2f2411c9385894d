// How a coupling scheme converges: residuals over passes, and what each pass takes off them over time.
#pragma once

#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {

/// Of passes.csv; none if no step took two passes.
std::vector<Figure> pass_figures(const Table& passes, double end_time);

}  // namespace splashdown::apps
