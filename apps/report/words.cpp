#include "apps/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace splashdown::apps {

namespace {

constexpr double volume_error_good = 0.005;  // the bar of all examples (docs/validation.md)

std::string status_sentence(const nlohmann::ordered_json& summary) {
  const std::string status = summary.value("status", "");
  if (status == "done") return "The run finished";
  if (status == "interrupted") return "The run was interrupted and can be resumed";
  if (status == "failed") return "The run could not go on";
  return "The run stopped";
}

/// The grade into the headline and its reasons first: nothing below counts if they are bad.
void add_verdict(const nlohmann::ordered_json& summary, Banner& banner) {
  if (!summary.contains("verdict")) return;  // of an earlier version
  const auto& verdict = summary["verdict"];
  const auto grade = text_at(verdict, "grade");
  banner.mood = std::max(banner.mood, mood_of_grade(grade));
  if (!grade.empty()) banner.headline += ": " + grade;
  if (!verdict.is_object() || !verdict.contains("reasons")) return;
  // What is told although the grade is good is no reason for green either.
  if (!verdict["reasons"].empty()) banner.mood = std::max(banner.mood, Mood::fair);
  for (const auto& reason : verdict["reasons"])
    if (reason.is_string())
      banner.sentences.push_back("<b class=\"" + std::string(mood_of_grade(grade) == Mood::bad ? "bad" : "fair") +
                                 "\">" + html_escaped(reason.get<std::string>()) + "</b>");
}

/// The command in a form that can be copied, then what it takes and brings.
void add_next(const nlohmann::ordered_json& summary, Banner& banner) {
  if (!summary.contains("next")) return;
  const auto command = text_at(summary["next"], "command"), text = text_at(summary["next"], "text");
  if (text.empty()) return;
  const auto end = command.empty() || !text.starts_with(command) ? text.find(',') : command.size();
  banner.sentences.push_back("Next: <code>" + html_escaped(text.substr(0, end)) + "</code>" +
                             (end < text.size() ? html_escaped(text.substr(end)) : "") + ".");
}

/// " (± 2.1 %)", with the grade if it is not resolved; nothing for what is not graded.
std::string band_text(const nlohmann::ordered_json& number) {
  const auto grade = text_at(number, "grade");
  if (grade.empty()) return {};
  const double band = number_at(number, {"band_percent"});
  const auto width = !std::isfinite(band) ? std::string("no band")
                     : band < 0.1         ? std::string("± less than 0.1 %")
                                          : "± " + digits(band, 2) + " %";
  return grade == "resolved" ? " (" + width + ")" : " (" + html_escaped(grade) + ", " + width + ")";
}

const nlohmann::ordered_json& at(const nlohmann::ordered_json& json, std::initializer_list<const char*> path) {
  static const nlohmann::ordered_json nothing;
  const auto* node = &json;
  for (const char* key : path) {
    if (!node->is_object() || !node->contains(key)) return nothing;
    node = &(*node)[key];
  }
  return *node;
}

void add_body_sentences(const RunData& run, std::vector<std::string>& sentences) {
  for (const auto& [name, body] : at(run.summary, {"bodies"}).items()) {
    const auto force = headline(body, "peak_force", run.dimension());
    if (!(force.value > 0)) continue;
    std::string text = fmt::format(
        "The largest load on <b>{}</b>, all directions together{}, was <b>{}</b>{} at {}", html_escaped(name),
        force.filter, digits_with_unit(force.value, force_unit(run.dimension())), force.band, seconds_text(force.time));
    if (const auto a = headline(body, "peak_acceleration_g", run.dimension()); a.value > 0) {
      text += fmt::format("; its centre of mass felt up to <b>{} g</b>{}{}", digits(a.value, 3), a.filter, a.band);
      for (const char* cfc : {"cfc1000", "cfc600", "cfc180", "cfc60"}) {
        const double filtered = number_at(body, {"peak_acceleration_g", cfc, "value"});
        if (!a.filter.empty() || !std::isfinite(filtered)) continue;
        text += fmt::format(" ({} g filtered by CFC {})", digits(filtered, 3), cfc + 3);
        break;
      }
    }
    sentences.push_back(text + ".");
  }
}

}  // namespace

ReportHeadline headline(const nlohmann::ordered_json& body, const std::string& key, int dimension) {
  const bool force = key == "peak_force";
  const auto& filtered =
      force ? at(body, {"peak_force_filtered", "cfc60"}) : at(body, {"peak_acceleration_g", "cfc60"});
  const auto& raw = force ? at(body, {"peak_force"}) : at(body, {"peak_acceleration_g", "raw"});
  const bool is_filtered = dimension == 3 && filtered.is_object();
  const auto& peak = is_filtered ? filtered : raw;
  const auto& grade =
      force ? at(body, is_filtered ? std::initializer_list<const char*>{"grades", "peak_force_filtered", "cfc60"}
                                   : std::initializer_list<const char*>{"grades", "peak_force"})
            : at(body, {"grades", "peak_acceleration_g", is_filtered ? "cfc60" : "raw"});
  return {number_at(peak, {"value"}), number_at(peak, {"time"}), is_filtered ? " (CFC 60)" : "", band_text(grade)};
}

std::string grade_text(const nlohmann::ordered_json& body, std::initializer_list<const char*> path) {
  const auto text = band_text(at(at(body, {"grades"}), path));
  return text.empty() ? "–" : text.substr(2, text.size() - 3);
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

std::string text_at(const nlohmann::ordered_json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

double number_at(const nlohmann::ordered_json& json, std::initializer_list<const char*> path) {
  const nlohmann::ordered_json* at = &json;
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
  const bool told = status == "failed" && !banner.sentences.empty();  // the verdict's reason has it
  if (!told && summary.contains("cause") && summary["cause"].is_string())
    banner.sentences.push_back("Cause: " + html_escaped(summary["cause"].get<std::string>()));
  add_next(summary, banner);
  banner.sentences.push_back(fmt::format("<b>{}</b> were simulated in <b>{}</b> of wall time, {} steps.",
                                         seconds_text(number_at(summary, {"simulated_time"})),
                                         seconds_text(number_at(summary, {"wall_seconds"})),
                                         count_text(number_at(summary, {"steps"}))));
  add_body_sentences(run, banner.sentences);
  const double error = number_at(summary, {"ledger", "volume_error"});
  if (std::isfinite(error)) {
    const bool good = std::abs(error) <= volume_error_good;
    banner.sentences.push_back(fmt::format("The water's volume changed by <b>{}</b>{}.", percent(error),
                                           good ? "" : ", more than the 0.5 % that the examples keep"));
    if (!good && banner.mood == Mood::good) banner.mood = Mood::fair;
  }
  const double gain = number_at(summary, {"ledger", "energy_gain"});
  if (std::isfinite(gain) && number_at(summary, {"ledger", "energy_scale"}) > 0)
    banner.sentences.push_back(fmt::format(
        "Its energy rose unexplained by <b>{}</b> of {}, the largest of what there was to give or to take ({}).",
        percent(gain), digits_with_unit(number_at(summary, {"ledger", "energy_scale"}), energy_unit(run.dimension())),
        html_escaped(text_at(summary["ledger"], "energy_scale_from"))));
  const double passes = number_at(summary, {"coupling", "passes_mean"});
  if (std::isfinite(passes)) {
    const double rejected = number_at(summary, {"coupling", "rejected_steps"});
    banner.sentences.push_back(
        fmt::format("The coupling took {} passes a step on average and {} at most; {}.", digits(passes, 3),
                    count_text(number_at(summary, {"coupling", "passes_max"})),
                    rejected > 0 ? count_text(rejected) + " steps were refused and repeated" : "no step was refused"));
  }
  return banner;
}

}  // namespace splashdown::apps
