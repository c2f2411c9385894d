// The page of a run: words, tables and figures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/report/curves/charts.hpp"
#include "apps/report/data.hpp"
#include "apps/report/figures.hpp"
#include "apps/report/pictures/field.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {

struct ReportPage {
  const RunData& run;
  Banner banner;
  std::vector<FieldFigure> fields, hulls;
  std::vector<FigureGroup> groups;
  std::map<std::string, std::string> images;  ///< figure name -> <svg> or <img> element
  std::vector<std::string> warnings;          ///< HTML
  std::string replay = {};                    ///< HTML; empty: none
  Charts charts = {};
};

std::string html_of(const ReportPage& page);

}  // namespace splashdown::apps
