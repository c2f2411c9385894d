// report.html from the folder of a study: its chart, and what became of each run.
#pragma once

#include <filesystem>

#include "apps/report/report.hpp"

namespace splashdown::apps {

bool holds_study(const std::filesystem::path& directory);

/// Reads study.json and the chart, nothing else: it works on a folder that was copied from a cluster, and
/// while runs are still at work. Draws the chart if that was not possible where the study was made.
ReportResult write_study_report(const std::filesystem::path& directory);

}  // namespace splashdown::apps
