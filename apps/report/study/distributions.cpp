#include "apps/report/study/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/page.hpp"
#include "apps/report/words.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

using Json = nlohmann::ordered_json;

namespace {

/// Of a picture, in its own units.
struct Plot {
  static constexpr double width = 300, height = 170, left = 12, right = 12, top = 10, bottom = 34;
};

/// A figure with a scale below it.
std::string picture(const std::string& body, double low, double high, const std::string& label,
                    const std::string& caption) {
  const auto number = [&](double x, const char* anchor, double value) {
    return fmt::format("<text x=\"{:.0f}\" y=\"{}\" text-anchor=\"{}\">{}</text>", x, Plot::height - 18, anchor,
                       digits(value, 3));
  };
  return fmt::format(
      "<figure><svg viewBox=\"0 0 {0} {1}\" width=\"100%\" role=\"img\" fill=\"currentColor\" "
      "font-size=\"11\">{2}<line x1=\"{3}\" "
      "y1=\"{4}\" x2=\"{5}\" y2=\"{4}\" stroke=\"currentColor\" stroke-opacity=\"0.4\"/>{6}{7}<text x=\"{8}\" "
      "y=\"{9}\" "
      "text-anchor=\"middle\">{10}</text></svg><figcaption>{11}</figcaption></figure>\n",
      Plot::width, Plot::height, body, Plot::left, Plot::height - Plot::bottom, Plot::width - Plot::right,
      number(Plot::left, "start", low), number(Plot::width - Plot::right, "end", high), Plot::width / 2,
      Plot::height - 5, html_escaped(label), caption);
}

double across(double value, double low, double high) {
  return Plot::left + (Plot::width - Plot::left - Plot::right) * (high > low ? (value - low) / (high - low) : 0.5);
}
double upwards(double share) { return Plot::height - Plot::bottom - (Plot::height - Plot::top - Plot::bottom) * share; }

/// A number of each run, of those that have it.
struct Column {
  std::string label;
  std::vector<double> values;
  std::vector<const Json*> runs;

  Column(const Json& study, const char* table, const std::string& name, const std::string& text) : label(text) {
    for (const auto& run : entries(study, "runs")) {
      const double value = number_at(run, {table, name.c_str()});
      if (text_at(run, "status") != "converged" || !std::isfinite(value)) continue;
      values.push_back(value);
      runs.push_back(&run);
    }
  }
  std::pair<double, double> range() const {
    const auto [low, high] = std::ranges::minmax(values);
    return {low, high};
  }
};

/// Classes of the width of Freedman and Diaconis (1981): twice the range of the middle half over the cube root of the number.
std::string histogram(const Column& column) {
  auto sorted = column.values;
  std::ranges::sort(sorted);
  const double low = sorted.front(), high = sorted.back();
  const double half = sorted[sorted.size() * 3 / 4] - sorted[sorted.size() / 4];
  const double width = 2 * half / std::cbrt(static_cast<double>(sorted.size()));
  const auto classes = static_cast<std::size_t>(width > 0 ? std::clamp(std::ceil((high - low) / width), 1., 60.) : 1);
  std::vector<double> counts(classes, 0);
  for (const double value : sorted)
    ++counts[std::min(classes - 1, static_cast<std::size_t>((value - low) / std::max(high - low, 1e-300) *
                                                            static_cast<double>(classes)))];
  const double most = std::ranges::max(counts),
               step = (Plot::width - Plot::left - Plot::right) / static_cast<double>(classes);
  std::string body;
  for (std::size_t k = 0; k < classes; ++k)
    body += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
        "fill-opacity=\"0.45\"><title>{}</title></rect>",
        Plot::left + step * static_cast<double>(k) + 0.5, upwards(counts[k] / most), std::max(step - 1, 0.5),
        upwards(0) - upwards(counts[k] / most), count_text(counts[k]));
  const auto at = [&](double share) {
    return across(sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))], low, high);
  };
  // Box plot: the middle half with the median, and 90 % of all.
  body += fmt::format(
      "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2}\" y2=\"{2}\" stroke=\"currentColor\"/><line x1=\"{3:.1f}\" "
      "x2=\"{4:.1f}\" "
      "y1=\"{2}\" y2=\"{2}\" stroke=\"currentColor\" stroke-width=\"5\"/><circle cx=\"{5:.1f}\" cy=\"{2}\" r=\"4\" "
      "fill=\"#c8501e\"/>",
      at(0.05), at(0.95), Plot::top - 4, at(0.25), at(0.75), at(0.5));
  return picture(body, low, high, column.label, "Number of runs. Above: the middle half, 90 % of all, and the median.");
}

/// "K = 15, angle = 30" as "K 15, angle 30".
std::string level_text(const Json& at) {
  std::string text;
  for (const auto& [axis, value] : at.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", axis,
                        value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

/// Rows of the statistics of a quantity by the values of one axis, and of several as long as they are few.
std::vector<const Json*> levels_of(const Json& study, const std::string& quantity) {
  constexpr double fewest = 3;  // runs a level: fewer have no box
  constexpr std::size_t most = 40;
  std::vector<std::pair<std::vector<std::string>, std::vector<const Json*>>> sets;
  for (const auto& row : entries(study["campaign"], "statistics")) {
    if (text_at(row, "quantity") != quantity || !row.contains("at") || !row["at"].is_object() || row["at"].empty())
      continue;
    std::vector<std::string> axes;
    for (const auto& [axis, value] : row["at"].items()) axes.push_back(axis);
    auto set = std::ranges::find(sets, axes, [](const auto& entry) { return entry.first; });
    if (set == sets.end()) set = sets.insert(set, {axes, {}});
    set->second.push_back(&row);
  }
  std::ranges::stable_sort(sets, {}, [](const auto& entry) { return entry.first.size(); });
  std::vector<const Json*> levels;
  for (const auto& [axes, rows] : sets)
    if (levels.size() + rows.size() <= most && rows.size() > 1 &&
        std::ranges::all_of(rows, [&](const Json* row) { return number_at(*row, {"runs"}) >= fewest; }))
      levels.insert(levels.end(), rows.begin(), rows.end());
  return levels;
}

/// Box plots by factor: the middle half with the median, and all runs of a level, on the scale of all levels.
std::string boxes(const Json& study, const std::string& quantity, const Column& column) {
  constexpr double row = 17, letter = 6.2, widest = 190;  // of 11 pixels
  const auto levels = levels_of(study, quantity);
  if (levels.empty()) return {};
  double label = 0;
  for (const auto* level : levels)
    label = std::min(widest, std::max(label, 8 + letter * static_cast<double>(level_text((*level)["at"]).size())));
  const auto [low, high] = column.range();
  const auto x = [&, from = low, to = high](double value) {
    return label + (Plot::width - Plot::right - label) * (to > from ? (value - from) / (to - from) : 0.5);
  };
  std::string body;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const auto number = [&](const char* name) { return number_at(*levels[k], {name}); };
    const double y = row * (static_cast<double>(k) + 0.5), quarter = x(number("quarter"));
    body += fmt::format(
        "<text x=\"0\" y=\"{0:.1f}\">{1}</text><line x1=\"{2:.1f}\" x2=\"{3:.1f}\" y1=\"{4:.1f}\" y2=\"{4:.1f}\" "
        "stroke=\"currentColor\"/><rect x=\"{5:.1f}\" y=\"{6:.1f}\" width=\"{7:.1f}\" height=\"{8:.1f}\" "
        "fill-opacity=\"0.45\"><title>{9} runs: {10} to {11}</title></rect><circle cx=\"{12:.1f}\" cy=\"{4:.1f}\" "
        "r=\"4\" "
        "fill=\"#c8501e\"><title>{13}</title></circle>",
        y + 4, html_escaped(level_text((*levels[k])["at"])), x(number("least")), x(number("most")), y, quarter, y - 5,
        std::max(x(number("three_quarters")) - quarter, 1.), 10., count_text(number("runs")),
        digits(number("least"), 3), digits(number("most"), 3), x(number("median")), digits(number("median"), 3));
  }
  const double height = row * static_cast<double>(levels.size()) + 16;
  body += fmt::format(
      "<text x=\"{:.0f}\" y=\"{:.0f}\">{}</text><text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"end\">{}</text>", label,
      height - 3, digits(low, 3), Plot::width - Plot::right, height - 3, digits(high, 3));
  return fmt::format(
      "<figure><svg viewBox=\"0 0 {0} {1}\" width=\"100%\" role=\"img\" fill=\"currentColor\" "
      "font-size=\"11\">{2}</svg><figcaption>{3} by factor: the middle half of the runs, their median, and all of "
      "them.</figcaption></figure>\n",
      Plot::width, height, body, html_escaped(column.label));
}

/// The mean of the first 2, 4, 8, ... runs with its band, on a logarithmic scale: each step halves the number of runs that a band stands for.
std::string convergence(const Json& row, const Column& column) {
  struct Part {
    double runs, mean, low, high;
  };
  std::vector<Part> parts;
  for (const auto& part : entries(row, "growth"))
    if (part.contains("band") && part["band"].is_array() && part["band"].size() == 2 && part["band"][0].is_number() &&
        part["band"][1].is_number())
      parts.push_back({number_at(part, {"runs"}), number_at(part, {"mean"}), part["band"][0].get<double>(),
                       part["band"][1].get<double>()});
  // Two runs have a band 4 to 9 times as wide as four of them: it would hide all others.
  std::erase_if(parts, [](const Part& part) { return part.runs < 4; });
  if (parts.size() < 2) return {};
  double low = parts.back().low, high = parts.back().high;
  for (const auto& part : parts) low = std::min(low, part.low), high = std::max(high, part.high);
  const auto y = [&](double value) { return upwards(high > low ? (value - low) / (high - low) : 0.5); };
  std::string body;
  for (const auto& part : parts) {
    const double x = across(std::log(part.runs), std::log(parts.front().runs / 1.3), std::log(parts.back().runs * 1.3));
    body += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"currentColor\" "
        "stroke-width=\"3\" stroke-opacity=\"0.55\"/><circle cx=\"{0:.1f}\" cy=\"{3:.1f}\" r=\"4\" "
        "fill=\"#c8501e\"><title>{4} runs: {5} ± {6}</title></circle>",
        x, y(part.low), y(part.high), y(part.mean), count_text(part.runs), digits(part.mean),
        digits((part.high - part.low) / 2, 2));
  }
  const auto at = row.contains("at") && row["at"].is_object() ? level_text(row["at"]) : std::string();
  return picture(
      body, parts.front().runs, parts.back().runs, "runs",
      fmt::format("Mean of {}{} with its band of 95 %, of so many runs. From {} to {}.", html_escaped(column.label),
                  at.empty() ? "" : ", " + html_escaped(at), digits(low, 3), digits(high, 3)));
}

std::string scatter(const Column& x, const Column& y) {
  const auto [x_low, x_high] = x.range();
  const auto [y_low, y_high] = y.range();
  std::string body;
  auto next = x.runs.begin();  // both are in the order of the study
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const auto at = std::find(next, x.runs.end(), y.runs[i]);
    if (at == x.runs.end()) continue;
    next = at;
    const auto name = html_escaped(text_at(*y.runs[i], "run"));
    body += fmt::format(
        "<a href=\"{0}/report.html\"><circle cx=\"{1:.1f}\" cy=\"{2:.1f}\" r=\"3\" fill-opacity=\"0.6\"><title>{0}: "
        "{3}</title></circle></a>",
        name, across(x.values[static_cast<std::size_t>(at - x.runs.begin())], x_low, x_high),
        upwards(y_high > y_low ? (y.values[i] - y_low) / (y_high - y_low) : 0.5), digits(y.values[i]));
  }
  return picture(
      body, x_low, x_high, x.label,
      fmt::format("{} from {} to {}, a point a run.", html_escaped(y.label), digits(y_low, 3), digits(y_high, 3)));
}

}  // namespace

std::string distributions(const Json& study) {
  std::string html;
  std::set<std::string> shown;
  for (const auto& row : entries(study["campaign"], "statistics")) {
    const auto name = text_at(row, "quantity");
    if (!shown.insert(name).second) continue;
    auto label = name;
    for (const auto& column : entries(study, "columns"))
      if (text_at(column, "name") == name) label = text_at(column, "label");
    const Column y(study, "numbers", name, label);
    if (y.values.size() < 5) continue;
    html += histogram(y) + boxes(study, name, y);
    std::size_t curves = 0;
    constexpr std::size_t most_curves = 8;  // of groups
    for (const auto& part : entries(study["campaign"], "statistics"))
      if (text_at(part, "quantity") == name && part.contains("growth") && curves < most_curves)
        html += convergence(part, y), ++curves;
    for (const auto& axis : entries(study, "axes")) {
      if (!axis.contains("random")) continue;
      const Column x(study, "axes", text_at(axis, "name"), text_at(axis, "label"));
      if (x.values.size() == y.values.size()) html += scatter(x, y);
    }
  }
  return html.empty() ? html : "<h2>Distributions</h2>\n<div class=\"grid\">" + html + "</div>\n";
}

}  // namespace splashdown::apps
