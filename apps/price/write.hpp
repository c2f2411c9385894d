// price.json, written and read back, and the price list as people read it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/price/price.hpp"

namespace splashdown::apps {

inline constexpr const char* price_file = "price.json";

std::string price_json(const Price& price);
/// Throws std::runtime_error for a file that is none.
Price read_price(const std::filesystem::path& file);

/// Head line, rows of accuracy and quantities.
std::string price_text(const Price& price);
/// "12 s", "6 min", "2.5 h"
std::string about_time(double seconds);
/// "mean of 12 runs, 8 more at 0.5"
std::string runs_text(const PriceRow& row);
/// "5 %: 12 s; 2 %: 70 s; 1 %: 6 min, extrapolated"
std::string price_line(const Price& price);

/// price.svg of work against precision. What hinders it; nothing: it is drawn.
std::optional<std::string> draw_price(const Price& price, const std::filesystem::path& folder);

}  // namespace splashdown::apps
