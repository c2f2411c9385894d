#include "apps/report/curves/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/record/frames/vtu_blocks.hpp"
#include "apps/report/curves/charts_script.hpp"
#include "apps/report/curves/reduction.hpp"
#include "apps/report/look/scripts.hpp"
#include "apps/report/look/theme.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_points = 3000;  // of a curve
constexpr double tolerance_of_axis = 1. / 5000;
// Debian's libjs-dygraphs.
const std::filesystem::path dygraphs = "/usr/share/javascript/dygraphs";

/// Seven digits are far below a pixel, at any zoom that the points are worth.
Json numbers(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double v : values) json.push_back(std::isfinite(v) ? Json::parse(fmt::format("{:.7g}", v)) : Json());
  return json;
}

std::string on_page(const std::string& colour) {
  const auto variable = colour_variable(colour);
  return variable.empty() ? colour : std::string(variable);
}

Json range_json(const AxisRange& range) { return range.low <= range.high ? Json{range.low, range.high} : Json(); }

Json curve_json(const Curve& curve, const AxisRange& range, bool log) {
  auto x = curve.x, y = curve.y;
  if (log)
    std::ranges::replace_if(
        y, [](double v) { return !(v > 0); }, NAN);
  if (!curve.points && curve.links.empty()) {
    thin(x, y, most_points);
    if (!curve.steps && !log) straighten(x, y, tolerance_of_axis * (range.high - range.low));
  }
  Json json = {{"label", curve.label}, {"colour", on_page(curve.colour)}, {"width", curve.width}};
  if (curve.right_axis) json["right"] = true;
  if (curve.steps) json["steps"] = true;
  if (curve.points) json["points"] = true;
  if (!curve.links.empty()) json["links"] = curve.links;
  json["x"] = numbers(x);
  json["y"] = numbers(y);
  return json;
}

Json chart_json(const Figure& figure) {
  const auto range = axis_range(figure, false), range2 = axis_range(figure, true);
  Json json = {{"name", figure.name},         {"x", figure.x_label},      {"y", figure.y_label},
               {"y2", figure.y2_label},       {"time", figure.over_time}, {"range", range_json(range)},
               {"range2", range_json(range2)}};
  if (figure.log_y) json["log"] = true;
  json["curves"] = Json::array();
  for (const auto& curve : figure.curves)
    if (std::ranges::any_of(curve.y, [](double v) { return std::isfinite(v); }))
      json["curves"].push_back(curve_json(curve, curve.right_axis ? range2 : range, figure.log_y));
  for (const auto& mark : figure.marks) json["marks"].push_back({mark.x, mark.y, mark.text});
  for (const auto& stretch : figure.stretches) json["stretches"].push_back({stretch.from, stretch.to, stretch.text});
  for (const auto& level : figure.levels) json["levels"].push_back({level.y, level.text});
  for (const auto& band : figure.between)
    json["between"].push_back(
        {{"text", band.text}, {"x", numbers(band.x)}, {"low", numbers(band.low)}, {"high", numbers(band.high)}});
  return json;
}

bool has_chart(const Figure& figure) {
  return std::ranges::any_of(figure.curves, [](const Curve& curve) {
    return std::ranges::any_of(curve.y, [](double v) { return std::isfinite(v); });
  });
}

}  // namespace

std::string charts_json(const std::vector<Figure>& figures, double seconds) {
  Json json = {{"seconds", seconds}, {"charts", Json::array()}};
  for (const auto& figure : figures)
    if (has_chart(figure)) json["charts"].push_back(chart_json(figure));
  return json.dump();
}

Charts charts_of(const std::vector<Figure>& figures, double seconds, bool later) {
  Charts charts;
  if (!later && std::ranges::none_of(figures, has_chart)) return charts;
  auto library = library_text(dygraphs / "dygraph.min.js"), style = library_text(dygraphs / "dygraph.min.css");
  if (library.empty() || style.empty()) {
    charts.warnings.emplace_back(
        "curves are pictures: dygraphs is not there (Debian: apt-get install libjs-dygraphs), then splashdown report");
    return charts;
  }
  for (auto* text : {&library, &style})
    if (const auto map = text->find("sourceMappingURL"); map != std::string::npos)
      text->erase(map, std::string_view("sourceMappingURL=").size());  // of a file that does not come along
  for (const auto& figure : figures)
    if (has_chart(figure)) charts.drawn.insert(figure.name);
  charts.html = fmt::format("<style>{}{}</style>\n<script type=\"text/plain\" id=\"charts-bytes\">{}</script>\n", style,
                            charts_style, stream_of(charts_json(figures, seconds)));
  for (const auto& script : {library, std::string(charts_script)}) charts.html += script_element(script);
  return charts;
}

}  // namespace splashdown::apps
