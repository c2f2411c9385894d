#include "apps/study/campaign/sample.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "apps/statistics/quantile.hpp"
#include "apps/study/design/shares.hpp"

namespace splashdown::apps {
namespace {

constexpr double outside = 0.05;  // of all campaigns

/// The narrowest pair of order statistics, alike from both ends, that holds the median in 95 %.
std::optional<Band> median_band_of(const std::vector<double>& sorted) {
  const auto n = sorted.size();
  const boost::math::binomial below(static_cast<double>(n), 0.5);
  std::optional<Band> band;
  for (std::size_t k = 0; 2 * k + 1 < n && 2 * boost::math::cdf(below, static_cast<double>(k)) <= outside; ++k)
    band = Band{sorted[k], sorted[n - 1 - k]};
  return band;
}

double deviation_of(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return 0;
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double mean_of_values(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}

constexpr int grid = 256;

/// A Gaussian kernel density on a grid that reaches three bandwidths beyond the values.
struct Density {
  std::vector<double> x, y;

  Density(const std::vector<double>& sorted, double bandwidth) {
    const double low = sorted.front() - 3 * bandwidth, high = sorted.back() + 3 * bandwidth;
    for (int i = 0; i < grid; ++i) {
      x.push_back(low + (high - low) * i / (grid - 1));
      double sum = 0;
      const auto first = std::ranges::lower_bound(sorted, x.back() - 6 * bandwidth);
      for (auto value = first; value != sorted.end() && *value < x.back() + 6 * bandwidth; ++value)
        sum += std::exp(-0.5 * std::pow((x.back() - *value) / bandwidth, 2));
      y.push_back(sum);
    }
  }
  int modes() const {
    int count = 0;
    for (std::size_t i = 1; i + 1 < y.size(); ++i) count += y[i] > y[i - 1] && y[i] >= y[i + 1] ? 1 : 0;
    return count;
  }
  /// The lowest point between the two highest modes.
  double split() const {
    std::vector<std::size_t> peaks;
    for (std::size_t i = 1; i + 1 < y.size(); ++i)
      if (y[i] > y[i - 1] && y[i] >= y[i + 1]) peaks.push_back(i);
    std::ranges::sort(peaks, std::ranges::greater(), [&](std::size_t i) { return y[i]; });
    const auto [a, b] = std::minmax(peaks[0], peaks[1]);
    const auto lowest =
        std::min_element(y.begin() + static_cast<std::ptrdiff_t>(a), y.begin() + static_cast<std::ptrdiff_t>(b));
    return x[static_cast<std::size_t>(lowest - y.begin())];
  }
};

/// The largest bandwidth that shows two modes: with a Gaussian kernel modes never grow with it (Silverman 1981).
double two_mode_bandwidth(const std::vector<double>& sorted) {
  double low = 0, high = sorted.back() - sorted.front();
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (Density(sorted, middle).modes() > 1 ? low : high) = middle;
  }
  return low;
}

/// The line from point `a` to `b` at point `i`.
double line_at(const std::vector<double>& x, const std::vector<double>& y, std::size_t a, std::size_t b,
               std::size_t i) {
  return y[a] + (y[b] - y[a]) * (x[i] - x[a]) / std::max(x[b] - x[a], std::numeric_limits<double>::min());
}

/// The greatest convex minorant (`side` 1) or least concave majorant (-1) of points `first` to `last`, at each of them.
std::vector<double> envelope(const std::vector<double>& x, const std::vector<double>& y, std::size_t first,
                             std::size_t last, double side) {
  std::vector<std::size_t> corners;
  for (std::size_t i = first; i <= last; ++i) {
    while (corners.size() > 1) {
      const auto b = corners.back(), a = corners[corners.size() - 2];
      if (side * (y[b] - line_at(x, y, a, i, b)) < 0) break;
      corners.pop_back();
    }
    corners.push_back(i);
  }
  std::vector<double> values;
  for (std::size_t i = first, k = 0; i <= last; ++i) {
    while (k + 1 < corners.size() && corners[k + 1] <= i) ++k;
    values.push_back(k + 1 < corners.size() ? line_at(x, y, corners[k], corners[k + 1], i) : y[i]);
  }
  return values;
}

/// The least distance between the distribution of these values and one that is convex up to a mode and concave after it (Hartigan and
/// Hartigan 1985): each jump of the former, from i/n to (i+1)/n, has both ends that near.
double dip(const std::vector<double>& sorted) {
  const auto n = sorted.size();
  std::vector<double> before, after;
  for (std::size_t i = 0; i < n; ++i) {
    before.push_back(static_cast<double>(i) / static_cast<double>(n));
    after.push_back(static_cast<double>(i + 1) / static_cast<double>(n));
  }
  double least = 1;
  for (std::size_t mode = 0; mode < n; ++mode) {
    double twice = 0;
    const auto convex = envelope(sorted, before, 0, mode, 1), concave = envelope(sorted, after, mode, n - 1, -1);
    for (std::size_t i = 0; i <= mode; ++i) twice = std::max(twice, after[i] - convex[i]);
    for (std::size_t i = mode; i < n; ++i) twice = std::max(twice, concave[i - mode] - before[i]);
    least = std::min(least, twice / 2);
  }
  return least;
}

/// At most this many of the values, evenly spaced in their order: the test needs no more.
std::vector<double> thinned(const std::vector<double>& sorted, std::size_t most) {
  if (sorted.size() <= most) return sorted;
  std::vector<double> kept;
  for (std::size_t i = 0; i < most; ++i) kept.push_back(sorted[i * (sorted.size() - 1) / (most - 1)]);
  return kept;
}

}  // namespace

double student(double freedom) { return boost::math::quantile(boost::math::students_t(freedom), 1 - outside / 2); }

std::optional<double> two_modes(const std::vector<double>& values) {
  constexpr std::size_t fewest = 20, enough = 200;
  constexpr int samples = 200, most_as_far = 10;  // 5 %
  if (values.size() < fewest || !(values.front() < values.back())) return {};
  const auto sorted = thinned(values, enough);
  const double found = dip(sorted);
  RandomShares random(1, "two modes");
  int as_far = 0;
  for (int i = 0; i < samples && as_far <= most_as_far; ++i) {
    std::vector<double> uniform;
    for (std::size_t k = 0; k < sorted.size(); ++k) uniform.push_back(random.share());
    std::ranges::sort(uniform);
    as_far += dip(uniform) >= found ? 1 : 0;
  }
  if (as_far > most_as_far) return {};
  return Density(sorted, two_mode_bandwidth(sorted)).split();
}

std::optional<Band> mean_band(const std::vector<double>& values) {
  if (values.size() < 2) return {};
  const double mean = mean_of_values(values);
  const auto n = static_cast<double>(values.size());
  const double half = student(n - 1) * deviation_of(values, mean) / std::sqrt(n);
  return Band{mean - half, mean + half};
}

SampleStatistics statistics_of(std::vector<double> values) {
  std::ranges::sort(values);
  SampleStatistics s;
  s.runs = values.size();
  s.mean = mean_of_values(values);
  s.deviation = deviation_of(values, s.mean);
  s.mean_band = mean_band(values);
  s.least = values.front();
  s.most = values.back();
  s.share_5 = quantile_of(values, 0.05);
  s.quarter = quantile_of(values, 0.25);
  s.median = quantile_of(values, 0.5);
  s.three_quarters = quantile_of(values, 0.75);
  s.share_95 = quantile_of(values, 0.95);
  s.median_band = median_band_of(values);
  s.split = two_modes(values);
  return s;
}

Band Probability::wilson() const {
  const double z = boost::math::quantile(boost::math::normal(), 1 - outside / 2);
  const double n = static_cast<double>(runs), p = estimate(), spread = z * z / n;
  const double middle = (p + spread / 2) / (1 + spread);
  const double half = z / (1 + spread) * std::sqrt(p * (1 - p) / n + spread / (4 * n));
  return {yes == 0 ? 0 : std::max(0., middle - half), yes == runs ? 1 : std::min(1., middle + half)};
}

Band Probability::clopper_pearson() const {
  using boost::math::binomial;
  const auto n = static_cast<double>(runs), k = static_cast<double>(yes);
  return {yes == 0 ? 0 : binomial::find_lower_bound_on_p(n, k, outside / 2),
          yes == runs ? 1 : binomial::find_upper_bound_on_p(n, k, outside / 2)};
}

}  // namespace splashdown::apps
