#include "apps/report/pairs/pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "apps/record/frames/vtu_blocks.hpp"
#include "apps/report/curves/reduction.hpp"
#include "apps/report/data.hpp"
#include "apps/report/look/scripts.hpp"
#include "apps/report/pairs/pairs_script.hpp"
#include "apps/report/study/maps.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_points_of_pair = 400, least_points_of_pair = 60, points_of_page = 300000;
constexpr std::size_t most_curves_of_run = 12;
constexpr std::uintmax_t largest_table = 200'000'000;  // bytes; longer ones would take seconds to read

const Json& list_of(const Json& json, const char* key) {
  static const Json none = Json::array();
  return json.is_object() && json.contains(key) && json[key].is_array() ? json[key] : none;
}

struct SharedCurve {
  std::string label;
  std::vector<double> x, y;
};

bool is_readable(const fs::path& table) {
  std::error_code absent;
  const auto size = fs::file_size(table, absent);
  return !absent && size <= largest_table;
}

/// What runs of one scene have in common: motion and load of each body, then probes.
std::vector<SharedCurve> curves_of(const fs::path& run, bool plane) {
  std::vector<SharedCurve> curves;
  const auto add = [&](const std::string& label, const Table& table, const std::string& column) {
    if (curves.size() < most_curves_of_run && !table["time"].empty() && table[column].size() == table["time"].size())
      curves.push_back({label, table["time"], table[column]});
  };
  const std::string up = plane ? "y" : "z";
  if (is_readable(run / "bodies.csv"))
    for (const auto& [body, table] : read_csv(run / "bodies.csv", "body")) {
      add(body + ": vertical load / " + (plane ? "(N/m)" : "N"), table, "f" + up);
      add(body + ": vertical acceleration / (m/s²)", table, "a" + up);
      add(body + ": vertical velocity / (m/s)", table, "v" + up);
      add(body + ": submergence / m", table, "submergence");
    }
  if (is_readable(run / "probes.csv"))
    for (const auto& [probe, table] : read_csv(run / "probes.csv", "probe")) add(probe, table, "value");
  return curves;
}

Json short_numbers(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double v : values) json.push_back(std::isfinite(v) ? Json::parse(fmt::format("{:.5g}", v)) : Json());
  return json;
}

Json curve_json(SharedCurve curve, std::size_t points) {
  thin(curve.x, curve.y, points);
  double low = INFINITY, high = -INFINITY;
  for (const double v : curve.y)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (high > low) straighten(curve.x, curve.y, 2e-3 * (high - low));  // a pixel of a small chart
  return {short_numbers(curve.x), short_numbers(curve.y)};
}

std::string axis_value(const Json& value) {
  return value.is_number()   ? fmt::format("{:g}", value.get<double>())
         : value.is_string() ? value.get<std::string>()
                             : "";
}

bool is_plane(const fs::path& run) {
  if (!fs::exists(run / "summary.json")) return true;
  const auto summary = Json::parse(read_text(run / "summary.json"), nullptr, false);
  return !summary.is_object() || summary.value("dimension", 2) == 2;
}

}  // namespace

std::string pairs_json(const fs::path& directory, const Json& study) {
  const auto& runs = list_of(study, "runs");
  Json json = {{"columns", Json::array()}, {"axes", Json::array()}, {"curves", Json::array()}, {"runs", Json::array()}};
  for (const auto& column : study_columns(study)) json["columns"].push_back({column.name, column.label});
  for (const auto& axis : list_of(study, "axes")) json["axes"].push_back(text_at(axis, "label"));
  std::map<std::string, std::size_t> numbers;                                           // of curves, by label
  const std::size_t each = points_of_page / std::max<std::size_t>(1, runs.size() * 6);  // curves a run, as a rule
  const bool with_curves = each >= least_points_of_pair;
  for (const auto& run : runs) {
    const auto name = text_at(run, "run");
    const auto folder = directory / name;
    Json entry = {{"name", name},
                  {"link", fs::exists(folder / "report.html") ? "./" + name + "/report.html" : ""},
                  {"status", text_at(run, "status")},
                  {"verdict", text_at(run, "verdict")},
                  {"axes", Json::array()},
                  {"numbers", member(run, "numbers")},
                  {"curves", Json::object()}};
    for (const auto& axis : list_of(study, "axes"))
      entry["axes"].push_back(axis_value(member(run, "axes").value(text_at(axis, "name"), Json())));
    if (with_curves)
      for (auto& curve : curves_of(folder, is_plane(folder))) {
        const auto [place, is_new] = numbers.try_emplace(curve.label, numbers.size());
        if (is_new) json["curves"].push_back({{"x", "t / s"}, {"y", curve.label}});
        entry["curves"][std::to_string(place->second)] =
            curve_json(std::move(curve), std::min(each, most_points_of_pair));
      }
    json["runs"].push_back(std::move(entry));
  }
  return json.dump();
}

std::string pick_cell(const std::string& run) {
  return "<label class=\"pick\" hidden><input type=\"checkbox\" data-run=\"" + html_escaped(run) +
         "\" aria-label=\"compare\"></label>";
}

std::string pairs_of(const fs::path& directory, const Json& study, bool charts) {
  if (list_of(study, "runs").size() < 2) return {};
  std::string html =
      "<section id=\"pairs\" hidden><h2>Two runs side by side</h2>\n<p class=\"where\">Choose two, here or by their "
      "boxes "
      "in the table of runs.</p>\n<div class=\"pair\"><label><i></i><select></select></label><label><i></i><select>"
      "</select></label></div>\n<div class=\"scroll\"><table><thead></thead><tbody></tbody></table></div>\n"
      "<div class=\"grid\"></div></section>\n";
  html += fmt::format("<script type=\"text/plain\" id=\"pairs-bytes\" data-charts=\"{}\">{}</script>\n",
                      charts ? "yes" : "no", stream_of(pairs_json(directory, study)));
  html += script_element(pairs_script);
  return html;
}

}  // namespace splashdown::apps
