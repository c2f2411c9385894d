#include "apps/report/answers/afloat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/report/answers/tile.hpp"
#include "apps/report/page.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

/// Of the lowest point below the level of the water, where the run ended [m]; nan: not recorded.
double draft_at_end(const RunData& run, const std::string& name) {
  for (const auto& [body, table] : run.bodies)
    if (body == name && !table["submergence"].empty()) return table["submergence"].back();
  return NAN;
}

std::string degree_text(double value) {
  const auto text = fmt::format("{:.1f}", std::abs(value));
  return (value < 0 && text != "0.0" ? "−" : "") + text + "°";
}

/// Draft, trim, heel at the end.
std::string lie_text(const RunData& run, const std::string& name, const Json& body) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (const double draft = draft_at_end(run, name); std::isfinite(draft))
    add(draft > 0 ? "draft " + digits_with_unit(draft, "m", 3) : digits_with_unit(-draft, "m", 3) + " above the water");
  for (const auto& [angle, word] : {std::pair{"pitch", "trim"}, {"roll", "heel"}})
    if (const double value = number_at(body, {"attitude_deg", angle, "end"}); std::isfinite(value))
      add(fmt::format("{} {}", word, degree_text(value)));
  return text;
}

/// Draft, trim, heel at rest.
std::string rest_text(const Json& rest) {
  std::string text = "at rest: draft " + digits_with_unit(number_at(rest, {"draft"}), "m", 3);
  for (const auto& [key, word] : {std::pair{"trim_deg", "trim"}, {"heel_deg", "heel"}})
    if (const double angle = number_at(rest, {key}); std::isfinite(angle))
      text += fmt::format(", {} {}", word, degree_text(angle));
  return text;
}

std::string metacentric_text(const Json& rest) {
  const double roll = number_at(rest, {"gm_roll"}), pitch = number_at(rest, {"gm_pitch"});
  if (!std::isfinite(pitch)) return {};
  const auto text = [](double height) { return digits_with_unit(height, "m", 3); };
  return std::isfinite(roll) ? fmt::format("GM {} in roll, {} in pitch", text(roll), text(pitch)) : "GM " + text(pitch);
}

std::vector<double> list_of_numbers(const Json& json, const char* key) {
  std::vector<double> list;
  if (json.contains(key) && json[key].is_array())
    for (const auto& value : json[key]) list.push_back(value.is_number() ? value.get<double>() : 0);
  return list;
}

/// The curve of righting levers, small.
std::string righting_sketch(const Json& rest) {
  const auto& righting = member(rest, "righting");
  const auto heels = list_of_numbers(righting, "heel_deg"), levers = list_of_numbers(righting, "gz");
  if (heels.size() < 3 || heels.size() != levers.size()) return {};
  constexpr double width = 168, height = 46, rim = 3;
  const auto [low, high] = std::ranges::minmax(levers);
  const double least = std::min(0., low), span = std::max(0., high) - least;
  if (!(span > 0)) return {};
  const auto across = [&](double heel) { return rim + (width - 2 * rim) * heel / heels.back(); };
  const auto down = [&](double lever) { return height - rim - (height - 2 * rim) * (lever - least) / span; };
  std::string path;
  for (std::size_t i = 0; i < heels.size(); ++i)
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", across(heels[i]), down(levers[i]));
  return fmt::format(
      "<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" aria-label=\"righting levers\">"
      "<path d=\"M0 {2:.1f}H{0}\" stroke=\"var(--c-axis)\" stroke-width=\".8\"/>"
      "<path d=\"{3}\" fill=\"none\" stroke=\"var(--c-blue)\" stroke-width=\"2\" stroke-linejoin=\"round\"/></svg>",
      width, height, down(0), path);
}

std::string righting_text(const Json& rest) {
  const auto& righting = member(rest, "righting");
  const auto levers = list_of_numbers(righting, "gz"), heels = list_of_numbers(righting, "heel_deg");
  if (levers.empty()) return {};
  const double up_to = number_at(righting, {"up_to_deg"});
  return fmt::format("GZ over 0 to {:.0f}° of heel, {} at most; {}", heels.back(),
                     digits_with_unit(std::ranges::max(levers), "m", 3),
                     up_to > 0 ? fmt::format("rights itself up to about {:.0f}°", up_to) : "does not right itself");
}

/// What statics say; whether they say anything.
bool add_rest(const Json& body, Lines& lines) {
  const auto& rest = member(body, "at_rest");
  const auto held = text_at(rest, "held");
  if (rest.empty()) return false;
  if (std::isfinite(number_at(rest, {"draft"}))) lines.add(rest_text(rest));
  if (!held.empty()) lines.add("held: " + html_escaped(held));
  lines.add(metacentric_text(rest));
  lines.html += righting_sketch(rest);
  lines.add(righting_text(rest));
  return true;
}

const char* rest_word(const Json& rest) {
  if (rest.value("sinks", false)) return "sinks";
  const double draft = number_at(rest, {"draft"});
  return draft > 0 || std::isnan(draft) ? "floats" : "hangs above the water";
}

}  // namespace

std::string floating_tiles(const RunData& run) {
  std::string html;
  const auto& bodies = member(run.summary, "bodies");
  for (const auto& [name, body] : bodies.items()) {
    const double settled = number_at(body, {"settled_time"}), capsized = number_at(body, {"capsized_time"});
    const bool moved_by_water =
        std::isfinite(settled) || !member(member(body, "grades"), "peak_acceleration_g").empty();
    const bool wet = std::isfinite(number_at(body, {"first_contact_time"})) && moved_by_water;
    Lines lines;
    const bool known = add_rest(body, lines);
    if (!wet && !known) continue;
    if (wet) {
      lines.add((known ? "the run ends: " : "") + lie_text(run, name, body) + (known ? "" : " at the end") +
                (bodies.size() > 1 ? ": " + html_escaped(name) : ""));
      if (std::isfinite(capsized)) lines.add("capsized since " + seconds_text(capsized), css_class(Mood::bad));
      lines.add(std::isfinite(settled) ? "settled since " + seconds_text(settled)
                                       : std::string("not settled within the run: this is no position of rest"));
    } else if (bodies.size() > 1) {
      lines.add(html_escaped(name));
    }
    const double skips = number_at(body, {"skips"});
    if (skips > 0) lines.add(fmt::format("left the water {} time{}", count_text(skips), skips > 1 ? "s" : ""));
    const char* now = std::isfinite(settled) ? "at rest" : "still moving";
    html += tile(std::isfinite(capsized) ? "capsized" : known ? rest_word(member(body, "at_rest")) : now, lines, known);
  }
  return html;
}

}  // namespace splashdown::apps
