#include "apps/report/answers/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/report/answers/afloat.hpp"
#include "apps/report/answers/tile.hpp"
#include "apps/report/page.hpp"
#include "apps/statistics/verdict/limits.hpp"

namespace splashdown::apps {

namespace {

using Json = nlohmann::ordered_json;

/// "belly above 20 kPa? 13.2 kPa ± 1.1 kPa"
std::string limit_text(const std::string& name, const Json& limit) {
  const auto text = [&](double value) { return value_text(value, text_at(limit, "unit")); };
  const char* side = limit.contains("above") ? "above" : "below";
  const double value = number_at(limit, {"value"}), band = number_at(limit, {"band"});
  auto words = fmt::format("{} {} {}?", name, side, text(number_at(limit, {side})));
  if (std::isfinite(value)) words += " " + text(value);
  if (std::isfinite(band)) words += " ± " + text(band);
  if (const double runs = number_at(limit, {"runs"}); runs > 0) words += ", mean of " + count_text(runs) + " runs";
  if (const auto reason = text_at(limit, "reason"); !reason.empty()) words += "; " + reason;
  return html_escaped(words);
}

std::string limit_tiles(const RunData& run) {
  std::string html;
  for (const auto& [name, limit] : member(run.summary, "limits").items()) {
    Lines lines;
    lines.add(limit_text(name, limit));
    html += tile(html_escaped(text_at(limit, "answer")), lines);
  }
  return html;
}

/// What several runs know of a number better than one, by its name.
struct OfRuns {
  double value = NAN, band = NAN, runs = 0;
  bool known() const { return std::isfinite(value) && std::isfinite(band) && runs > 1; }
};
OfRuns mean_of(const RunData& run, const std::string& name) {
  const auto& mean = member(member(member(run.summary, "mean_of_runs"), "quantities"), name.c_str());
  return {number_at(mean, {"value"}), number_at(mean, {"band"}), number_at(mean, {"runs"})};
}

/// The band of a mean in place of the grade of the run's own number, which stands below it.
void add_mean(const OfRuns& mean, const std::string& band, const std::string& own, Lines& lines) {
  lines.add(fmt::format("mean of {} runs ± {}", count_text(mean.runs), band),
            css_class(mean.band <= 0.1 * std::abs(mean.value) ? Mood::good : Mood::fair));
  lines.add("this run alone: " + own);
}

/// A peak, by the class that the verdict goes by; raw where the record is too short for it.
struct Shown {
  const Json& peak;
  const char* grade;   ///< its key among the grades
  const char* filter;  ///< ", CFC 60"
};
Shown shown(const Json& peaks) {
  const auto& filtered = member(peaks, "cfc60");
  if (number_at(filtered, {"value"}) > 0) return {filtered, "cfc60", ", CFC 60"};
  return {member(peaks, "raw"), "raw", ", raw"};
}

/// `grades`: of the classes of the peaks; `mean`: of the class that is shown.
std::string acceleration_tile(const std::string& what, const Json& peaks, const Json& grades, const OfRuns& mean) {
  const auto [peak, key, filter] = shown(peaks);
  const double value = number_at(peak, {"value"});
  constexpr double least = 1e-6;  // g: what roundoff leaves of a motion that is prescribed
  if (!(value > least)) return {};
  Lines lines;
  lines.add(html_escaped("peak acceleration" + what) + filter + ", at " + seconds_text(number_at(peak, {"time"})));
  if (mean.known())
    add_mean(mean, digits(mean.band, 2) + " g", digits(value, 3) + " g", lines);
  else
    lines.add(grade_words(member(grades, key)));
  const auto& pulse = shown_pulse(peaks);
  std::string text;
  if (const double dv = number_at(pulse, {"delta_v"}); std::isfinite(dv)) text = "Δv " + digits_with_unit(dv, "m/s", 3);
  if (const double rise = number_at(pulse, {"rise_time"}); std::isfinite(rise))
    text += (text.empty() ? "" : ", ") + std::string("rises in ") + seconds_text(rise);
  lines.add(text);
  return tile(digits(mean.known() ? mean.value : value, 3) + " g", lines);
}

/// An instrument at the centre of mass says the same twice.
bool is_at_a_point(const RunData& run, const Json& peaks) {
  const auto& of_body = shown(peaks).peak;
  const double value = number_at(of_body, {"value"}), time = number_at(of_body, {"time"});
  const auto& points = member(run.summary, "equipment");
  return std::any_of(points.begin(), points.end(), [&](const Json& point) {
    const auto& peak = shown(point).peak;
    return std::abs(number_at(peak, {"value"}) - value) <= 1e-3 * value && number_at(peak, {"time"}) == time;
  });
}

std::string acceleration_tiles(const RunData& run) {
  std::string html;
  for (const auto& [name, point] : member(run.summary, "equipment").items())
    html += acceleration_tile(" at " + name, point, member(point, "grades"),
                              mean_of(run, name + ".peak_g_" + shown(point).grade));
  const auto& bodies = member(run.summary, "bodies");
  for (const auto& [name, body] : bodies.items()) {
    if (bodies.size() == 1 && is_at_a_point(run, member(body, "peak_acceleration_g"))) continue;
    html +=
        acceleration_tile(bodies.size() > 1 ? " of " + name : " of the centre of mass",
                          member(body, "peak_acceleration_g"), member(member(body, "grades"), "peak_acceleration_g"),
                          mean_of(run, name + ".peak_g_" + shown(member(body, "peak_acceleration_g")).grade));
  }
  return html;
}

std::string pressure_tile(const std::string& what, const Json& peak, const Json& grade, const OfRuns& mean) {
  const double value = number_at(peak, {"value"});
  if (!(value > 0)) return {};
  Lines lines;
  lines.add(html_escaped(what) + ", at " + seconds_text(number_at(peak, {"time"})));
  if (mean.known())
    add_mean(mean, digits_with_unit(mean.band, "Pa", 2), digits_with_unit(value, "Pa", 3), lines);
  else
    lines.add(grade_words(grade));
  return tile(digits_with_unit(mean.known() ? mean.value : value, "Pa", 3), lines);
}

/// The largest of the patches; in the plane, where it converges, that of each hull.
std::string pressure_tiles(const RunData& run) {
  std::string html;
  const auto& patches = member(run.summary, "patches");
  const auto pressure = [](const Json& patch) {
    const double value = number_at(patch, {"peak_pressure", "value"});
    return std::isfinite(value) ? value : 0;
  };
  std::string highest;
  for (const auto& [name, patch] : patches.items())
    if (highest.empty() || pressure(patch) > pressure(patches[highest])) highest = name;
  if (!highest.empty())
    html += pressure_tile(
        (patches.size() > 1 ? fmt::format("highest of {} patches: mean over ", patches.size()) : "peak, mean over ") +
            highest,
        member(patches[highest], "peak_pressure"), member(member(patches[highest], "grades"), "peak_pressure"),
        mean_of(run, highest + ".peak_pressure"));
  if (run.dimension() == 2)
    for (const auto& [name, body] : member(run.summary, "bodies").items())
      html +=
          pressure_tile("highest pressure on " + name, member(body, "maximum_pressure"),
                        member(member(body, "grades"), "maximum_pressure"), mean_of(run, name + ".maximum_pressure"));
  return html;
}

std::string stress_tiles(const RunData& run) {
  std::string html;
  for (const auto& [name, body] : member(run.summary, "bodies").items()) {
    const auto& peak = member(body, "peak_von_mises");
    const auto part = peak.value("part", std::string());
    html += pressure_tile("highest von Mises stress in " + name + (part.empty() ? "" : ", " + part), peak,
                          member(member(body, "grades"), "peak_von_mises"), mean_of(run, name + ".peak_von_mises"));
  }
  return html;
}

/// "x", "uy" or "f1" of what it is named after.
std::string goal_words(const std::string& of, const std::string& goal) {
  const auto rest = html_escaped(goal.substr(1));
  if (goal.size() == 1) return fmt::format("load on {} along {}", html_escaped(of), html_escaped(goal));
  if (goal.front() == 'f') return fmt::format("natural frequency {} of {}", rest, html_escaped(of));
  return fmt::format("displacement of {} along {}", html_escaped(of), rest);
}

std::string goal_tiles(const RunData& run) {
  std::string html;
  for (const auto& [of, goals] : member(run.summary, "goals").items())
    for (const auto& [name, goal] : goals.items()) {
      const auto unit = goal.value("unit", force_unit(run.dimension()));
      Lines lines;
      lines.add(goal_words(of, name));
      lines.add("error of the mesh " + digits_with_unit(number_at(goal, {"error"}), unit, 2) + ", by the adjoint");
      html += tile(digits_with_unit(number_at(goal, {"value"}), unit, 5), lines);
    }
  return html;
}

std::string load_tiles(const RunData& run) {
  std::string html;
  const auto& bodies = member(run.summary, "bodies");
  for (const auto& [name, body] : bodies.items()) {
    const bool filtered = number_at(body, {"peak_force_filtered", "cfc60", "value"}) > 0;
    const auto& peak = filtered ? member(member(body, "peak_force_filtered"), "cfc60") : member(body, "peak_force");
    const auto& grades = member(body, "grades");
    if (!(number_at(peak, {"value"}) > 0)) continue;
    Lines lines;
    lines.add(fmt::format("peak load, all directions together{}{}, at {}",
                          bodies.size() > 1 ? ", on " + html_escaped(name) : "", filtered ? ", CFC 60" : ", raw",
                          seconds_text(number_at(peak, {"time"}))));
    const auto mean = mean_of(run, name + (filtered ? ".peak_force_cfc60" : ".peak_force_raw"));
    const auto unit = force_unit(run.dimension());
    const double value = number_at(peak, {"value"});
    if (mean.known())
      add_mean(mean, digits_with_unit(mean.band, unit, 2), digits_with_unit(value, unit, 3), lines);
    else
      lines.add(grade_words(filtered ? member(member(grades, "peak_force_filtered"), "cfc60")
                                     : member(grades, "peak_force")));
    html += tile(digits_with_unit(mean.known() ? mean.value : value, unit, 3), lines);
  }
  return html;
}

}  // namespace

std::string answer_card(const RunData& run) {
  return html_tiles(limit_tiles(run) + acceleration_tiles(run) + pressure_tiles(run) + stress_tiles(run) +
                    goal_tiles(run) + load_tiles(run) + floating_tiles(run));
}

std::string quiet_line(const RunData& run) {
  std::vector<std::string> parts;
  const auto number = [&](std::initializer_list<const char*> path) { return number_at(run.summary, path); };
  if (const double t = number({"simulated_time"}); std::isfinite(t))
    parts.push_back(fmt::format("{} were simulated in {} of wall time, {} steps", seconds_text(t),
                                seconds_text(number({"wall_seconds"})), count_text(number({"steps"}))));
  if (const double n = number({"nodes", "max"}); n > 0) parts.push_back(count_text(n) + " nodes at most");
  if (const double e = number({"ledger", "volume_error"}); std::isfinite(e)) {
    const double hulls = number({"ledger", "volume_error_bodies"});
    parts.push_back(fmt::format("change of the water's volume {}{}{}", percent(e),
                                std::isfinite(hulls) ? ", over the hulls " + percent(hulls) : "",
                                volume_is_kept(run) ? "" : ": more than the 0.5 % that the examples keep"));
  }
  const double gain = number({"ledger", "energy_gain"}), scale = number({"ledger", "energy_scale"});
  if (std::isfinite(gain))
    parts.push_back(fmt::format("energy gain of the water {}{}", percent(gain),
                                scale > 0 ? " of " + digits_with_unit(scale, energy_unit(run.dimension())) : ""));
  if (const double passes = number({"coupling", "passes_mean"}); std::isfinite(passes)) {
    const double refused = number({"coupling", "rejected_steps"});
    parts.push_back(fmt::format("{} coupling passes a step, {} at most", digits(passes, 3),
                                count_text(number({"coupling", "passes_max"}))));
    if (refused > 0)
      parts.push_back(fmt::format("{} step{} refused and repeated", count_text(refused), refused > 1 ? "s" : ""));
  }
  std::string line;
  for (const auto& part : parts) line += (line.empty() ? "" : "; ") + part;
  return line.empty() ? line : "<p class=\"quiet\">" + line + ".</p>\n";
}

}  // namespace splashdown::apps
