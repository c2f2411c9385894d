#include "apps/report/curves/filtered_curves.hpp"

#include <algorithm>
#include <cmath>

#include "apps/statistics/filters.hpp"

namespace splashdown::apps {

namespace {

bool rise(const std::vector<double>& times) {
  return std::ranges::adjacent_find(times, [](double a, double b) { return !(b > a); }) == times.end();
}

}  // namespace

std::optional<FilteredCurves> filtered_curves(const Table& rows, const std::vector<std::string>& columns, int cfc) {
  const auto& t = rows["time"];
  if (t.size() < 3 || !rise(t)) return {};
  IntervalHistory history;
  history.channels = static_cast<int>(columns.size());
  history.begin = t[0] - 0.5 * (t[1] - t[0]);
  std::vector<double> sample(columns.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto& values = rows[columns[k]];
      if (values.size() != t.size() || !std::isfinite(values[i])) return {};
      sample[k] = values[i];
    }
    history.append(i + 1 < t.size() ? 0.5 * (t[i] + t[i + 1]) : t[i] + 0.5 * (t[i] - t[i - 1]), sample);
  }
  const auto smooth = filtered(history, cfc);
  if (!smooth) return {};
  FilteredCurves curves{{}, std::vector<std::vector<double>>(columns.size())};
  for (std::size_t i = 0; i < smooth->ends.size(); ++i) {
    const double middle = smooth->middle_of(i);
    if (middle < t.front() || middle > t.back()) continue;
    curves.t.push_back(middle);
    for (std::size_t k = 0; k < columns.size(); ++k) curves.values[k].push_back(smooth->values[i * columns.size() + k]);
  }
  if (curves.t.empty()) return {};
  return curves;
}

}  // namespace splashdown::apps
