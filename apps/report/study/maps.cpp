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

constexpr std::size_t most_curves = series_colours.size(), most_bars = 200;

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

/// Where the values of an axis stand, in the order in which a map or a table of bars has them.
class Places {
 public:
  Places(const Json& study, const std::string& axis) : axis_(axis), of_numbers_(is_of_numbers(study, axis)) {
    for (const auto& entry : entries(study, "axes"))
      if (text_at(entry, "name") == axis)
        for (const auto& value : entries(entry, "values"))
          if (value.is_string()) words_.push_back(value.get<std::string>());
  }
  /// The number itself, or that of the word.
  double of(const Json& run) const {
    if (of_numbers_) return number_at(run, {"axes", axis_.c_str()});
    return static_cast<double>(std::ranges::find(words_, text_at(member(run, "axes"), axis_.c_str())) - words_.begin());
  }
  std::string text(double place) const {
    if (of_numbers_) return fmt::format("{:g}", place);
    const auto word = static_cast<std::size_t>(place);
    return word < words_.size() ? html_escaped(words_[word]) : "–";
  }

 private:
  std::string axis_;
  bool of_numbers_;
  std::vector<std::string> words_;
};

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

/// Of schemes and other words: the study's own, then what each costs.
std::vector<StudyColumn> compared_quantities(const Json& study) {
  auto columns = study_columns(study);
  std::erase_if(columns, [](const StudyColumn& column) {
    return !column.own && column.name != "passes_mean" && column.name != "wall_seconds";
  });
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
  const Places across(study, axes.first), down(study, axes.second);
  std::map<double, std::map<double, const Json*>> rows;  // by the second axis, then the first
  std::map<double, int> heads;
  double low = INFINITY, high = -INFINITY;
  for (const auto& run : entries(study, "runs")) {
    const double x = across.of(run), y = down.of(run), value = number_at(run, {"numbers", quantity.name.c_str()});
    rows[y][x] = &run;
    heads[x] = 1;
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  std::string html = fmt::format(
      "<figure class=\"heat\"><figcaption><b>{}</b></figcaption><div class=\"scroll\"><table><thead><tr><th>{} \\ "
      "{}</th>",
      html_escaped(quantity.label), html_escaped(axis_label(study, axes.second)),
      html_escaped(axis_label(study, axes.first)));
  for (const auto& [x, unused] : heads) html += "<th>" + across.text(x) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    html += "<tr><th>" + down.text(row->first) + "</th>";
    for (const auto& [x, unused] : heads) {
      const auto run = row->second.find(x);
      html += run == row->second.end() ? "<td class=\"none\"></td>"
                                       : map_cell(directory, *run->second, quantity.name, low, high);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></figure>\n";
}

/// How the cells of a quantity show it: by bars from zero, or by marks between the lowest and the highest.
class BarScale {
 public:
  BarScale(const Json& study, const std::string& quantity) {
    for (const auto& run : entries(study, "runs"))
      if (const double value = number_at(run, {"numbers", quantity.c_str()}); std::isfinite(value))
        low_ = std::min(low_, value), high_ = std::max(high_, value);
    log_ = low_ > 0 && high_ > decades_of_bars * low_;
    marks_ = log_ || low_ < 0;
  }
  bool is_log() const { return log_; }
  /// HTML of a cell.
  std::string cell(double value, const std::string& text) const {
    if (!std::isfinite(value)) return "<td class=\"none\">" + text + "</td>";
    const double share = log_        ? std::log(value / low_) / std::log(high_ / low_)
                         : marks_    ? (high_ > low_ ? (value - low_) / (high_ - low_) : 0.5)
                         : high_ > 0 ? value / high_
                                     : 0;
    return fmt::format("<td class=\"{}\" style=\"--s:{:.1f}%\"><span>{}</span></td>", marks_ ? "spot" : "length",
                       marks_ ? 2 + 96 * share : 100 * share, text);
  }

 private:
  static constexpr double decades_of_bars = 100;  // a bar a hundredth as long as another is not seen
  double low_ = INFINITY, high_ = -INFINITY;
  bool log_ = false, marks_ = false;
};

}  // namespace

std::string study_bars(const fs::path& directory, const Json& study) {
  const auto axes = varied_axes(study);
  if (axes.empty() || axes.size() == 2 ||
      std::ranges::any_of(axes, [&](const std::string& axis) { return is_of_numbers(study, axis); }))
    return {};
  const auto quantities = compared_quantities(study);
  if (quantities.empty() || entries(study, "runs").size() > most_bars) return {};
  std::string head, rows;
  for (const auto& axis : axes) head += "<th>" + html_escaped(axis_label(study, axis)) + "</th>";
  std::vector<BarScale> scales;
  for (const auto& quantity : quantities) {
    scales.emplace_back(study, quantity.name);
    head +=
        "<th class=\"text\">" + html_escaped(quantity.label) + (scales.back().is_log() ? ", log scale" : "") + "</th>";
  }
  for (const auto& run : entries(study, "runs")) {
    const auto link = report_of(directory, run), status = text_at(run, "status");
    rows += "<tr>";
    for (const auto& axis : axes) {
      const auto text = html_escaped(axis_text(run, axis));
      rows += link.empty() ? "<td>" + text + "</td>"
                           : fmt::format("<td><a href=\"{}\">{}</a></td>", html_escaped(link), text);
    }
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      const double value = number_at(run, {"numbers", quantities[k].name.c_str()});
      rows += scales[k].cell(value, std::isfinite(value)    ? digits(value, 3)
                                    : status == "converged" ? std::string("–")
                                                            : "× " + html_escaped(status));
    }
    rows += "</tr>\n";
  }
  return "<h2>Compared</h2>\n<div class=\"scroll\"><table class=\"bars\"><thead><tr>" + head +
         "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

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
  if (has_random_axes(study) || axes.size() != 2 || is_of_numbers(study, axes[0]) != is_of_numbers(study, axes[1]))
    return {};
  std::string html;
  for (const auto& quantity : is_of_numbers(study, axes[0]) ? own_quantities(study) : compared_quantities(study))
    html += heat_map(directory, study, quantity, {axes[0], axes[1]});
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
