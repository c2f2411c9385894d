#include "apps/report/curves/section_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "apps/record/frames/frames.hpp"
#include "apps/report/curves/style.hpp"
#include "apps/report/words.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

/// Lowest and highest value at each station.
Between envelope_of(const Table& rows, const Values& values, double scale) {
  std::map<double, std::pair<double, double>> at;
  const auto& stations = rows["station"];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    auto& [low, high] = at.try_emplace(stations[i], INFINITY, -INFINITY).first->second;
    low = std::min(low, values[i]), high = std::max(high, values[i]);
  }
  Between band{"all recorded steps", {}, {}, {}};
  for (const auto& [station, range] : at) {
    band.x.push_back(station);
    band.low.push_back(range.first * scale);
    band.high.push_back(range.second * scale);
  }
  return band;
}

Curve curve_at(const Table& rows, const Values& values, double time, double scale) {
  Curve curve{"", {}, {}, ink, 1.8};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (rows["time"][i] != time) continue;
    curve.x.push_back(rows["station"][i]);
    curve.y.push_back(values[i] * scale);
  }
  return curve;
}

/// Of the largest hogging and sagging moments, those that there are.
struct Bent {
  const char* what;
  double time;
  const char* colour;
};
std::vector<Bent> instants_of(const Table& rows) {
  const auto &bending = rows["bending"], &time = rows["time"];
  if (bending.empty() || time.empty()) return {};
  const auto [low, high] = std::ranges::minmax_element(bending);
  const auto time_of = [&](const auto& place) { return time[static_cast<std::size_t>(place - bending.begin())]; };
  std::vector<Bent> instants;
  if (*high > 0) instants.push_back({"most hogging", time_of(high), ink});
  if (*low < 0) instants.push_back({"most sagging", time_of(low), amber});
  return instants;
}

}  // namespace

std::vector<Figure> section_figures(const std::string& record, const Table& rows, int dimension, double end_time) {
  const Unit time = time_unit(end_time);
  const auto instants = instants_of(rows);
  std::vector<Figure> figures;
  for (const auto& [column, words, unit_name] : {std::tuple{"shear", "shear force", force_unit(dimension)},
                                                 {"bending", "bending moment", moment_unit(dimension)}}) {
    const auto& values = rows[column];
    if (values.empty() || instants.empty()) continue;
    const Unit unit = si_unit(largest(values), unit_name);
    Figure figure;
    figure.name = fmt::format("section_{}_{}", column, file_name_of(record));
    figure.x_label = "station / m";
    figure.y_label = fmt::format("{} / ({})", words, unit.unit);
    figure.between = {envelope_of(rows, values, unit.scale)};
    for (const auto& instant : instants) {
      auto curve = curve_at(rows, values, instant.time, unit.scale);
      curve.label = fmt::format("{}, {} {}", instant.what, digits(instant.time * time.scale, 3), time.unit);
      curve.colour = instant.colour;
      figure.curves.push_back(std::move(curve));
    }
    figure.caption =
        std::string(column) == "shear"
            ? "<b>" + html_escaped(record) +
                  "</b>: shear force, positive where the part ahead is pushed up. Unfiltered, as the water's load "
                  "of a step."
            : "<b>" + html_escaped(record) +
                  "</b>: bending moment, positive where the body hogs. Behind the body it returns to zero unless "
                  "something else holds it.";
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace splashdown::apps
