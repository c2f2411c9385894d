#include "apps/report/study/envelopes.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/page.hpp"
#include "apps/report/words.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

struct PlaneCell {
  double probability = 0;
  bool by_neighbours = false;  ///< it has no run of its own
  std::string title;           ///< under the mouse
};

/// A limit over two axes of numbers.
struct LimitPlane {
  using Column = std::map<double, PlaneCell, std::greater<>>;  // by y, from above

  std::string x, y;
  double level = 0.5;
  bool chosen = false;  ///< runs were chosen near the line
  std::map<double, Column> columns;

  const PlaneCell* beside(std::map<double, Column>::const_iterator column, double height) const {
    if (column == columns.begin()) return nullptr;
    const auto& left = std::prev(column)->second;
    const auto cell = left.find(height);
    return cell == left.end() ? nullptr : &cell->second;
  }
  bool crosses(const PlaneCell* one, const PlaneCell& other) const {
    return one && (one->probability > level) != (other.probability > level);
  }
};

std::optional<double> number_in(const Json& value) {
  const auto text = value.is_string() ? value.get<std::string>() : std::string();
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

std::string band_title(const Json& row) {
  if (!row.contains("band") || !row["band"].is_array() || row["band"].size() != 2) return {};
  const auto end = [&](std::size_t k) { return row["band"][k].is_number() ? row["band"][k].get<double>() : NAN; };
  return fmt::format("{:.0f} to {:.0f} %", 100 * end(0), 100 * end(1));
}

/// By groups of the study's other axes.
LimitPlane plane_of_groups(const Json& campaign, const std::string& limit) {
  LimitPlane plane;
  for (const auto& row : entries(campaign, "probabilities")) {
    if (text_at(row, "limit") != limit || !row.contains("at") || row["at"].size() != 2) continue;
    std::vector<std::pair<std::string, double>> at;
    for (const auto& [axis, value] : row["at"].items())
      if (const auto number = number_in(value)) at.emplace_back(axis, *number);
    if (at.size() != 2) continue;
    // Groups by other pairs of axes have planes of their own, which nobody asked for.
    if (!plane.columns.empty() && (plane.x != at[0].first || plane.y != at[1].first)) continue;
    plane.x = at[0].first;
    plane.y = at[1].first;
    plane.columns[at[0].second][at[1].second] = {.probability = number_at(row, {"probability"}),
                                                 .title = band_title(row)};
  }
  return plane;
}

LimitPlane plane_of_envelope(const Json& envelope) {
  LimitPlane plane{.x = text_at(envelope, "x"), .y = text_at(envelope, "y"), .chosen = true, .columns = {}};
  plane.level = number_at(envelope, {"level"});
  for (const auto& row : entries(envelope, "cells")) {
    const double runs = number_at(row, {"yes"}) + number_at(row, {"no"}) + number_at(row, {"within_the_band"});
    plane.columns[number_at(row, {"x"})][number_at(row, {"y"})] = {
        .probability = number_at(row, {"probability"}),
        .by_neighbours = !(runs > 0),
        .title = fmt::format("yes in {} of {} runs, on the other side of the line with {:.0f} %",
                             count_text(number_at(row, {"yes"})), count_text(runs), 100 * number_at(row, {"doubt"}))};
  }
  return plane;
}

std::string cell_html(const PlaneCell& cell, const std::string& line) {
  const bool most = cell.probability > 0.5;
  const char *open = cell.by_neighbours ? "<i>~"
                     : most             ? "<b>"
                                        : "",
             *close = cell.by_neighbours ? "</i>"
                      : most             ? "</b>"
                                         : "";
  return fmt::format("<td style=\"background:rgba(200,60,40,{:.2f}){}\" title=\"{}\">{}{:.0f} %{}</td>",
                     0.6 * cell.probability, line, cell.title, open, 100 * cell.probability, close);
}

std::string html_of(const LimitPlane& plane, const std::string& limit) {
  std::string html = fmt::format("<figure><div class=\"scroll\"><table class=\"map\"><thead><tr><th>{} \\ {}</th>",
                                 html_escaped(plane.y), html_escaped(plane.x));
  std::set<double, std::greater<>> heights;
  for (const auto& [at, column] : plane.columns) {
    html += fmt::format("<th>{:g}</th>", at);
    for (const auto& [height, cell] : column) heights.insert(height);
  }
  html += "</tr></thead><tbody>\n";
  for (const double height : heights) {
    html += fmt::format("<tr><th>{:g}</th>", height);
    for (auto column = plane.columns.begin(); column != plane.columns.end(); ++column) {
      const auto cell = column->second.find(height);
      if (cell == column->second.end()) {
        html += "<td>–</td>";
        continue;
      }
      const auto above = cell == column->second.begin() ? nullptr : &std::prev(cell)->second;
      std::string line;
      if (plane.crosses(plane.beside(column, height), cell->second)) line += ";border-left:2px solid";
      if (plane.crosses(above, cell->second)) line += ";border-top:2px solid";
      html += cell_html(cell->second, line);
    }
    html += "</tr>\n";
  }
  return html + fmt::format(
                    "</tbody></table></div><figcaption>Envelope of {}: share of runs beyond it, with the line of {:g} "
                    "%. {}</figcaption></figure>\n",
                    html_escaped(limit), 100 * plane.level,
                    plane.chosen ? "Runs were made where the line was least known. Slanted: by cells nearby, without a "
                                   "run of its own. Under the mouse: runs."
                                 : "Under the mouse its band of 95 %. Bold: in most runs.");
}

}  // namespace

std::string envelopes(const Json& campaign) {
  std::string html;
  std::set<std::string> limits;
  for (const auto& row : entries(campaign, "probabilities")) limits.insert(text_at(row, "limit"));
  std::string chosen;
  if (campaign.contains("envelope")) {
    chosen = text_at(campaign["envelope"], "limit");
    limits.insert(chosen);
  }
  for (const auto& limit : limits) {
    const auto plane = limit == chosen ? plane_of_envelope(campaign["envelope"]) : plane_of_groups(campaign, limit);
    if (plane.columns.size() > 1) html += html_of(plane, limit);
  }
  return html.empty() ? html : "<h2>Envelopes</h2>\n<div class=\"grid\">" + html + "</div>\n";
}

}  // namespace splashdown::apps
