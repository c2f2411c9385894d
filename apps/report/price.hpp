// The page of a price list: rows, chart and quantities of price.json.
#pragma once

#include "apps/report/report.hpp"

namespace splashdown::apps {

bool holds_price(const std::filesystem::path& directory);
ReportResult write_price_report(const std::filesystem::path& directory);

}  // namespace splashdown::apps
