// Peaks, grades and the banner over a run, in words.
#pragma once

#include <string>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

/// A peak of a body that stands for all: raw in the plane, in space, where raw peaks do not converge, of CFC 60.
struct ReportHeadline {
  double value, time;
  std::string filter, band;  ///< " (CFC 60)", " (doubtful, ± 7 %)" or nothing
};
/// `key`: "peak_force" or "peak_acceleration_g".
ReportHeadline headline(const nlohmann::ordered_json& body, const std::string& key, int dimension);
/// Grade and band of a number of a body, where its grades have it.
std::string grade_text(const nlohmann::ordered_json& body, std::initializer_list<const char*> path);

std::string html_escaped(const std::string& text);

enum class Mood { good, fair, bad };  ///< the worse the later
struct Banner {
  Mood mood;
  std::string headline;                ///< plain text
  std::vector<std::string> sentences;  ///< HTML
};
Banner banner_of(const RunData& run);
/// Of a grade of verdicts; good for what is none.
Mood mood_of_grade(const std::string& grade);

/// A JSON object's text; none if absent or no text.
std::string text_at(const nlohmann::ordered_json& json, const char* key);
/// JSON value at a path such as {"ledger", "volume_error"}; nan if absent or null.
double number_at(const nlohmann::ordered_json& json, std::initializer_list<const char*> path);

}  // namespace splashdown::apps
