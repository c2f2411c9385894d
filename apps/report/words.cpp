#include "apps/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/statistics/verdict/statements.hpp"

namespace splashdown::apps {

namespace {

using Json = nlohmann::ordered_json;

constexpr double volume_error_good = 0.005;  // the bar of all examples (docs/validation.md)

std::string status_sentence(const Json& summary) {
  const std::string status = summary.value("status", "");
  if (status == "done") return "The run finished";
  if (status == "interrupted") return "The run was interrupted and can be resumed";
  if (status == "failed") return "The run could not go on";
  return "The run stopped";
}

std::vector<std::string> texts_at(const Json& json, const char* key) {
  std::vector<std::string> texts;
  if (!json.is_object() || !json.contains(key) || !json[key].is_array()) return texts;
  for (const auto& text : json[key])
    if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}

/// Below each other behind a word; HTML.
std::string verdict_line(const char* head, const std::string& html) {
  return fmt::format("<span class=\"head\">{}</span><span>{}</span>", head, html);
}

std::string lines_html(const std::vector<std::string>& statements) {
  std::string html;
  for (const auto& group : grouped(statements)) html += (html.empty() ? "" : "<br>") + html_escaped(group);
  return html.empty() ? "nothing" : html;
}

/// A command in a form that can be copied, then what it takes and brings.
std::string advice_html(const Json& summary, const std::string& advice) {
  const auto command = summary.contains("next") ? text_at(summary["next"], "command") : "";
  if (command.empty() || !advice.starts_with(command)) return html_escaped(advice);
  return "<code>" + html_escaped(command) + "</code>" + html_escaped(advice.substr(command.size()));
}

/// All reasons as they stand in summary.json, folded away if something says them shorter.
std::string details_html(const Json& verdict) {
  const auto reasons = texts_at(verdict, "reasons");
  if (reasons.empty()) return {};
  std::string html = std::string(verdict.contains("trusted") ? "<details>" : "<details open>") +
                     "<summary>why, with the numbers</summary><ul>";
  for (const auto& reason : reasons) html += "<li>" + html_escaped(reason) + "</li>";
  return html + "</ul></details>";
}

/// The grade into the headline, then what is trusted, what is not, what to do.
void add_verdict(const Json& summary, Banner& banner) {
  if (!summary.contains("verdict")) return;  // of an earlier version
  const auto& verdict = summary["verdict"];
  const auto grade = text_at(verdict, "grade");
  banner.mood = std::max(banner.mood, mood_of_grade(grade));
  if (!grade.empty()) banner.headline += ": " + grade;
  // What is told although the grade is good is no reason for green either.
  if (!texts_at(verdict, "reasons").empty()) banner.mood = std::max(banner.mood, Mood::fair);
  const auto trusted = texts_at(verdict, "trusted"), doubted = texts_at(verdict, "doubted");
  if (verdict.contains("trusted")) banner.sentences.push_back(verdict_line("trust", lines_html(trusted)));
  if (!doubted.empty()) banner.sentences.push_back(verdict_line("doubt", lines_html(doubted)));
  for (const auto& advice : texts_at(verdict, "advice"))
    banner.sentences.push_back(verdict_line("do", advice_html(summary, advice)));
  for (const auto& note : texts_at(verdict, "notes"))
    banner.sentences.push_back(verdict_line("note", html_escaped(note)));
  if (auto details = details_html(verdict); !details.empty()) banner.sentences.push_back(std::move(details));
}

double band_of(const Json& number) { return number_at(number, {"band_percent"}) / 100; }

/// "± 2.1 %", with the grade if it is not resolved; nothing for what is not graded.
std::string band_text(const Json& number) {
  const auto grade = text_at(number, "grade");
  if (grade.empty()) return {};
  const auto width = band_mark(band_of(number), "± ");
  return grade == "resolved" ? width : html_escaped(grade) + ", " + width;
}

const Json& at(const Json& json, std::initializer_list<const char*> path) {
  static const Json nothing;
  const auto* node = &json;
  for (const char* key : path) {
    if (!node->is_object() || !node->contains(key)) return nothing;
    node = &(*node)[key];
  }
  return *node;
}

}  // namespace

GradeWords grade_words(const Json& number) {
  const auto grade = text_at(number, "grade");
  if (grade.empty()) return {};
  return {mood_of_grade(grade), grade == "unphysical" ? grade : band_words(band_of(number))};
}

std::string grade_text(const Json& body, std::initializer_list<const char*> path) {
  const auto text = band_text(at(at(body, {"grades"}), path));
  return text.empty() ? "–" : text;
}

std::string html_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string text_at(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

double number_at(const Json& json, std::initializer_list<const char*> path) {
  const Json* at = &json;
  for (const char* key : path) {
    if (!at->is_object() || !at->contains(key)) return std::numeric_limits<double>::quiet_NaN();
    at = &(*at)[key];
  }
  return at->is_number() ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Mood mood_of_grade(const std::string& grade) {
  if (grade == "unphysical") return Mood::bad;
  return grade == "doubtful" || grade == "unresolved" ? Mood::fair : Mood::good;
}

Banner banner_of(const RunData& run) {
  if (!run.summary.is_object())
    return {Mood::fair,
            "No summary yet",
            {fmt::format("There is no summary.json: the run is still going on, or it was killed. Its files reach "
                         "to t = {}.",
                         seconds_text(run.end_time()))}};
  const auto& summary = run.summary;
  const std::string status = summary.value("status", "");
  Banner banner{status == "done"     ? Mood::good
                : status == "failed" ? Mood::bad
                                     : Mood::fair,
                status_sentence(summary),
                {}};
  add_verdict(summary, banner);
  const bool told = status == "failed" && !banner.sentences.empty();  // the verdict has it
  if (!told && summary.contains("cause") && summary["cause"].is_string())
    banner.sentences.push_back("Cause: " + html_escaped(summary["cause"].get<std::string>()));
  if (!volume_is_kept(run)) banner.mood = std::max(banner.mood, Mood::fair);
  return banner;
}

bool volume_is_kept(const RunData& run) {
  const double error = number_at(run.summary, {"ledger", "volume_error"});
  return !(std::abs(error) > volume_error_good);
}

const Json& entries(const Json& json, const char* key) {
  static const Json none = Json::array();
  return json.is_object() && json.contains(key) && json[key].is_array() ? json[key] : none;
}

const Json& member(const Json& json, const char* key) {
  static const Json nothing = Json::object();
  return json.is_object() && json.contains(key) && json[key].is_object() ? json[key] : nothing;
}

const Json& shown_pulse(const Json& acceleration) {
  for (const char* cfc : {"cfc180", "cfc60", "cfc600", "cfc1000"})
    if (acceleration.contains(cfc)) return acceleration[cfc];
  return member(acceleration, "none");
}

}  // namespace splashdown::apps
