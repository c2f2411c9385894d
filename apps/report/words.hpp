// Numbers with units and the banner over a run, in words.
#pragma once

#include <string>
#include <vector>

#include "apps/report/data.hpp"

namespace splashdown::apps {

/// value * scale is in `unit`.
struct Unit {
  double scale = 1;
  std::string unit;
};

/// Picks the prefix (none, k, M, G; or m for small values) that suits `largest`.
Unit si_unit(double largest, const std::string& unit);
Unit time_unit(double end_time);
std::string force_unit(int dimension);   ///< N/m or N
std::string moment_unit(int dimension);  ///< N m/m or N m
std::string energy_unit(int dimension);  ///< J/m or J

/// `count` significant digits, with a power of ten outside 1e-4 to 1e7; "–" for nan.
std::string digits(double value, int count = 4);
std::string with_unit(double value, const std::string& unit, int digits = 4);  ///< with an SI prefix
std::string seconds_text(double seconds);                                      ///< "840 ms", "13.2 s", "2 h 05 min"
/// A peak of a body that stands for all: raw in the plane, in space, where raw peaks do not converge, of CFC 60.
struct ReportHeadline {
  double value, time;
  std::string filter, band;  ///< " (CFC 60)", " (doubtful, ± 7 %)" or nothing
};
/// `key`: "peak_force" or "peak_acceleration_g".
ReportHeadline headline(const nlohmann::ordered_json& body, const std::string& key, int dimension);
/// Grade and band of a number of a body, where its grades have it.
std::string grade_text(const nlohmann::ordered_json& body, std::initializer_list<const char*> path);

std::string percent(double share);
std::string count_text(double count);

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
