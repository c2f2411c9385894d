#include "apps/study/campaign/sobol_indices.hpp"

#include <algorithm>
#include <cmath>

#include "apps/study/design/shares.hpp"

namespace splashdown::apps {
namespace {

/// Numbers of one row: A, B, and A with each axis of B.
using Row = std::vector<double>;

std::vector<Row> complete_rows(std::span<const std::optional<double>> values, std::size_t axes) {
  std::vector<Row> rows;
  const std::size_t number = values.size() / (axes + 2);
  for (std::size_t r = 0; r < number; ++r) {
    Row row;
    for (std::size_t block = 0; block < axes + 2; ++block)
      if (const auto& value = values[block * number + r]; value && std::isfinite(*value)) row.push_back(*value);
    if (row.size() == axes + 2) rows.push_back(std::move(row));
  }
  return rows;
}

/// First and total index of each axis, one after the other, from the rows of these numbers.
std::vector<double> estimates(const std::vector<Row>& rows, const std::vector<std::size_t>& chosen, std::size_t axes) {
  double sum = 0, squares = 0;
  std::vector<double> found(2 * axes, 0);
  const double shift = rows[chosen.front()][0];  // keeps digits where the mean is large
  for (const std::size_t r : chosen) {
    const auto& row = rows[r];
    for (const double y : {row[0] - shift, row[1] - shift}) sum += y, squares += y * y;
    for (std::size_t a = 0; a < axes; ++a) {
      found[2 * a] += std::pow(row[1] - row[2 + a], 2);
      found[2 * a + 1] += std::pow(row[0] - row[2 + a], 2);
    }
  }
  const double n = static_cast<double>(chosen.size()), variance = squares / (2 * n) - std::pow(sum / (2 * n), 2);
  for (std::size_t a = 0; a < axes; ++a) {
    found[2 * a] = 1 - found[2 * a] / (2 * n * variance);
    found[2 * a + 1] /= 2 * n * variance;
  }
  return found;
}

Band band_of(std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {at(0.025), at(0.975)};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(std::span<const std::optional<double>> values, std::size_t axes,
                                      std::size_t& rows) {
  constexpr std::size_t fewest = 8;
  constexpr int samples = 500;
  const auto complete = complete_rows(values, axes);
  rows = complete.size();
  const bool varies = std::ranges::any_of(
      complete, [&](const Row& row) { return row[0] != complete[0][0] || row[1] != complete[0][0]; });
  if (rows < fewest || !varies) return {};
  std::vector<std::size_t> chosen(rows);
  for (std::size_t r = 0; r < rows; ++r) chosen[r] = r;
  const auto all = estimates(complete, chosen, axes);
  std::vector<std::vector<double>> drawn(2 * axes);
  RandomShares random(1, "sobol indices");
  for (int s = 0; s < samples; ++s) {
    for (auto& r : chosen) r = static_cast<std::size_t>(random.share() * static_cast<double>(rows));
    const auto sample = estimates(complete, chosen, axes);
    for (std::size_t k = 0; k < sample.size(); ++k)
      if (std::isfinite(sample[k])) drawn[k].push_back(sample[k]);
  }
  std::vector<SobolIndex> indices;
  for (std::size_t a = 0; a < axes; ++a)
    indices.push_back({.first = all[2 * a],
                       .total = all[2 * a + 1],
                       .first_band = band_of(drawn[2 * a]),
                       .total_band = band_of(drawn[2 * a + 1])});
  return indices;
}

}  // namespace splashdown::apps
