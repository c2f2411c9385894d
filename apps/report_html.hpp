// The report's page: words, tables and figures in one file without links to elsewhere.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/report_data.hpp"
#include "apps/report_field.hpp"
#include "apps/report_figures.hpp"
#include "apps/report_words.hpp"

namespace splashdown::apps {

struct ReportPage {
  const RunData& run;
  Verdict verdict;
  std::vector<FieldFigure> fields;
  std::vector<FigureGroup> groups;
  std::map<std::string, std::string> images;  ///< figure name -> <svg> or <img> element
  std::vector<std::string> warnings;          ///< HTML
};

std::string html_of(const ReportPage& page);

/// An <svg> element made fit for a page with many: no prolog, ids of its own, the page's fonts.
std::string inline_svg(const std::string& svg, const std::string& name);
/// An <img> element that holds a PNG file's bytes.
std::string inline_png(const std::string& bytes, const std::string& alternative_text);

}  // namespace splashdown::apps
