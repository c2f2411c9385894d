// report.html from the files of a run or of a study: one page that needs no network.
//
// Figures are drawn by gnuplot (a subprocess; a run's scripts stay in DIR/report/). Without gnuplot the page
// has its words and tables and says how to get the figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

struct ReportResult {
  std::filesystem::path page;
  std::vector<std::string> warnings;  ///< e.g. gnuplot missing, a file unreadable
};

/// Throws std::runtime_error if DIR holds neither a run nor a study, or if the page cannot be written.
ReportResult write_report(const std::filesystem::path& directory);

}  // namespace splashdown::apps
