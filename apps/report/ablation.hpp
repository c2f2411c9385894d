// The page of an ablation: verdicts, chart and changes of ablation.json.
#pragma once

#include "apps/report/report.hpp"

namespace splashdown::apps {

bool holds_ablation(const std::filesystem::path& directory);
ReportResult write_ablation_report(const std::filesystem::path& directory);

}  // namespace splashdown::apps
