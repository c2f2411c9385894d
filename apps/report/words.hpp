// Peaks, grades and the banner over a run, in words.
#pragma once

#include <string>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

enum class Mood { good, fair, bad };  ///< the worse the later

/// Grade and band of a number of a body, where its grades have it.
std::string grade_text(const nlohmann::ordered_json& body, std::initializer_list<const char*> path);

/// How far a graded number may be off (statements.hpp), from its entry among the grades; nothing for what is not graded.
struct GradeWords {
  Mood mood = Mood::good;
  std::string words;
};
GradeWords grade_words(const nlohmann::ordered_json& number);

std::string html_escaped(const std::string& text);

struct Banner {
  Mood mood;
  std::string headline;                ///< plain text
  std::vector<std::string> sentences;  ///< HTML
};
Banner banner_of(const RunData& run);
/// Whether the water's volume changed by no more than the bar of all examples; true where nothing is known.
bool volume_is_kept(const RunData& run);
/// Of a grade of verdicts; good for what is none.
Mood mood_of_grade(const std::string& grade);

/// A JSON object's text; none if absent or no text.
std::string text_at(const nlohmann::ordered_json& json, const char* key);
/// Its list of this name; an empty one if there is none.
const nlohmann::ordered_json& entries(const nlohmann::ordered_json& json, const char* key);
/// Its object of this name; an empty one if there is none.
const nlohmann::ordered_json& member(const nlohmann::ordered_json& json, const char* key);
/// The pulse of the class that J211 gives for integration to velocity, or of the lowest that the run's steps allow.
const nlohmann::ordered_json& shown_pulse(const nlohmann::ordered_json& acceleration);
/// JSON value at a path such as {"ledger", "volume_error"}; nan if absent or null.
double number_at(const nlohmann::ordered_json& json, std::initializer_list<const char*> path);

}  // namespace splashdown::apps
