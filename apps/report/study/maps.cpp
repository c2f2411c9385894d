#include "apps/report/study/maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/report/curves/style.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_curves = series_colours.size();

std::string report_of(const fs::path& directory, const Json& run) {
  const auto name = text_at(run, "run");
  return fs::exists(directory / name / "report.html") ? "./" + name + "/report.html"
                                                      : "";  // never a scheme such as "javascript:"
}

/// Names of the axes along which runs differ.
std::vector<std::string> varied_axes(const Json& study) {
  std::vector<std::string> names;
  for (const auto& axis : entries(study, "axes"))
    if (entries(axis, "values").size() > 1) names.push_back(text_at(axis, "name"));
  return names;
}

/// Values that come by chance make no map and no line.
bool has_random_axes(const Json& study) {
  return std::ranges::any_of(entries(study, "axes"), [](const Json& axis) { return axis.contains("random"); });
}

bool is_of_numbers(const Json& study, const std::string& axis) {
  return std::ranges::all_of(entries(study, "runs"), [&](const Json& run) {
    return std::isfinite(number_at(run, {"axes", axis.c_str()}));
  });
}

std::string axis_label(const Json& study, const std::string& name) {
  for (const auto& axis : entries(study, "axes"))
    if (text_at(axis, "name") == name) return text_at(axis, "label");
  return name;
}

std::vector<StudyColumn> own_quantities(const Json& study) {
  auto columns = study_columns(study);
  std::erase_if(columns, [](const StudyColumn& column) { return !column.own; });
  return columns;
}

std::string axis_text(const Json& run, const std::string& axis) {
  const double number = number_at(run, {"axes", axis.c_str()});
  return std::isfinite(number) ? fmt::format("{:g}", number) : text_at(member(run, "axes"), axis.c_str());
}

/// A cell: darker the higher, on either ground; runs that broke down are crossed out.
std::string map_cell(const fs::path& directory, const Json& run, const std::string& quantity, double low, double high) {
  const double value = number_at(run, {"numbers", quantity.c_str()});
  const auto link = report_of(directory, run), status = text_at(run, "status");
  auto text = std::isfinite(value) ? digits(value, 3) : status == "converged" ? std::string("–") : "× " + status;
  text = html_escaped(text);
  if (!link.empty()) text = fmt::format("<a href=\"{}\">{}</a>", html_escaped(link), text);
  if (!std::isfinite(value)) return "<td class=\"none\">" + text + "</td>";
  const double share = high > low ? (value - low) / (high - low) : 0.5;
  return fmt::format("<td style=\"--s:{:.0f}%\">{}</td>", 8 + 72 * share, text);
}

std::string heat_map(const fs::path& directory, const Json& study, const StudyColumn& quantity,
                     const std::pair<std::string, std::string>& axes) {
  std::map<double, std::map<double, const Json*>> rows;  // by the second axis, then the first
  std::map<double, int> heads;
  double low = INFINITY, high = -INFINITY;
  for (const auto& run : entries(study, "runs")) {
    const double x = number_at(run, {"axes", axes.first.c_str()}), y = number_at(run, {"axes", axes.second.c_str()}),
                 value = number_at(run, {"numbers", quantity.name.c_str()});
    rows[y][x] = &run;
    heads[x] = 1;
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  std::string html = fmt::format(
      "<figure class=\"heat\"><figcaption><b>{}</b></figcaption><div class=\"scroll\"><table><thead><tr><th>{} \\ "
      "{}</th>",
      html_escaped(quantity.label), html_escaped(axis_label(study, axes.second)),
      html_escaped(axis_label(study, axes.first)));
  for (const auto& [x, unused] : heads) html += fmt::format("<th>{:g}</th>", x);
  html += "</tr></thead><tbody>\n";
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    html += fmt::format("<tr><th>{:g}</th>", row->first);
    for (const auto& [x, unused] : heads) {
      const auto run = row->second.find(x);
      html += run == row->second.end() ? "<td class=\"none\"></td>"
                                       : map_cell(directory, *run->second, quantity.name, low, high);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></figure>\n";
}

}  // namespace

std::vector<StudyColumn> study_columns(const Json& study) {
  const auto& units = member(study, "units");
  std::vector<StudyColumn> columns;
  for (const auto& entry : entries(study, "columns")) {
    StudyColumn column{text_at(entry, "name"), text_at(entry, "label")};
    const auto of = column.name.ends_with("_error") ? column.name.substr(0, column.name.rfind('_')) : column.name;
    column.own = units.contains(column.name) || units.contains(of);
    if (std::ranges::any_of(entries(study, "runs"), [&](const Json& run) {
          return std::isfinite(number_at(run, {"numbers", column.name.c_str()}));
        }))
      columns.push_back(std::move(column));
  }
  std::stable_partition(columns.begin(), columns.end(), [](const StudyColumn& column) { return column.own; });
  return columns;
}

std::string heat_maps(const fs::path& directory, const Json& study) {
  const auto axes = varied_axes(study);
  if (has_random_axes(study) || axes.size() != 2 || !is_of_numbers(study, axes[0]) || !is_of_numbers(study, axes[1]))
    return {};
  std::string html;
  for (const auto& quantity : own_quantities(study)) html += heat_map(directory, study, quantity, {axes[0], axes[1]});
  return html.empty() ? html : "<h2>Maps</h2>\n<div class=\"grid\">" + html + "</div>\n";
}

std::vector<Figure> study_lines(const fs::path& directory, const Json& study) {
  if (has_random_axes(study)) return {};
  auto axes = varied_axes(study);
  const auto along = std::ranges::find_if(axes, [&](const std::string& axis) { return is_of_numbers(study, axis); });
  if (along == axes.end() || (axes.size() == 2 && is_of_numbers(study, axes[0]) && is_of_numbers(study, axes[1])))
    return {};
  const std::string x_axis = *along;
  axes.erase(along);
  std::vector<Figure> figures;
  for (const auto& quantity : own_quantities(study)) {
    std::map<std::string, std::map<double, const Json*>> curves;  // by the values of the other axes
    for (const auto& run : entries(study, "runs")) {
      std::string name;
      for (const auto& axis : axes) name += (name.empty() ? "" : ", ") + axis_text(run, axis);
      if (std::isfinite(number_at(run, {"numbers", quantity.name.c_str()})))
        curves[name][number_at(run, {"axes", x_axis.c_str()})] = &run;
    }
    if (curves.empty() || curves.size() > most_curves) continue;
    Figure figure;
    figure.name = "study_" + std::to_string(figures.size());
    figure.x_label = axis_label(study, x_axis);
    figure.y_label = quantity.label;
    figure.caption = "<b>" + html_escaped(quantity.label) + "</b>. A click on a point leads to its run.";
    for (const auto& [name, points] : curves) {
      Curve curve{.label = name, .x = {}, .y = {}, .colour = series_colours[figure.curves.size()], .width = 1.8};
      for (const auto& [x, run] : points) {
        curve.x.push_back(x);
        curve.y.push_back(number_at(*run, {"numbers", quantity.name.c_str()}));
        curve.links.push_back(report_of(directory, *run));
      }
      figure.curves.push_back(std::move(curve));
    }
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace splashdown::apps
