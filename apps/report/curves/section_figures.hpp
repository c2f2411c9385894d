// Shear force and bending moment along a body.
#pragma once

#include <string>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {

/// Of a record in section_loads.csv: both at the instants of the largest bending moments, before what they were in all recorded steps.
std::vector<Figure> section_figures(const std::string& record, const Table& rows, int dimension, double end_time);

}  // namespace splashdown::apps
