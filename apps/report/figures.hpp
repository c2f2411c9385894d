// Which curves a run's report shows, and what they say.
#pragma once

#include <string>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {

struct FigureGroup {
  std::string title;
  std::vector<Figure> figures;
};

/// Groups without a figure are left out: what a run does not have, its report does not mention.
std::vector<FigureGroup> figures_of(const RunData& run);

}  // namespace splashdown::apps
