#include "apps/filters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace splashdown::apps {

namespace {

// Finer sampling than J211 asks for, so that averaging over the interval costs less than 0.1 % at the
// cut-off: 1 - sinc(pi / 0.6 / 40) = 0.3 % is already too much at 40 samples, 80 give 0.07 %.
constexpr double samples_per_cfc = 80;
constexpr double required_samples_per_cfc = 10;  // SAE J211-1, section 9.1

struct Biquad {
  double a0, a1, a2, b1, b2;

  /// In place, starting from the steady state of the first sample.
  void run(std::vector<double>& x) const {
    if (x.empty()) return;
    double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
    for (double& value : x) {
      const double y = a0 * value + a1 * x1 + a2 * x2 + b1 * y1 + b2 * y2;
      x2 = x1;
      x1 = value;
      y2 = y1;
      y1 = y;
      value = y;
    }
  }
};

Biquad butterworth(double dt, int cfc) {
  const double wa = std::tan(std::numbers::pi * 2.0775 * cfc * dt);  // prewarped for the bilinear transform
  const double scale = 1 / (1 + std::numbers::sqrt2 * wa + wa * wa);
  const double a0 = wa * wa * scale;
  return {a0, 2 * a0, a0, -2 * (wa * wa - 1) * scale, (-1 + std::numbers::sqrt2 * wa - wa * wa) * scale};
}

/// Longest interval that overlaps [from, to].
double longest_interval(const IntervalHistory& history, double from, double to) {
  const auto& ends = history.ends;
  double longest = 0;
  for (std::size_t i = static_cast<std::size_t>(std::ranges::lower_bound(ends, from) - ends.begin());
       i < ends.size(); ++i) {
    const double begin = i == 0 ? history.begin : ends[i - 1];
    if (begin > to) break;
    longest = std::max(longest, ends[i] - begin);
  }
  return longest;
}

std::optional<Peak> filtered_peak(const IntervalHistory& history, int cfc) {
  const double span = history.ends.back() - history.begin, period = 1.0 / cfc;
  if (span < period) return std::nullopt;
  const double dt = 1 / (samples_per_cfc * cfc);
  std::vector<double> squared;
  for (int channel = 0; channel < history.channels; ++channel) {
    const auto filtered = cfc_filter(resample(history, channel, dt), dt, cfc);
    squared.resize(filtered.size());
    for (std::size_t i = 0; i < filtered.size(); ++i) squared[i] += filtered[i] * filtered[i];
  }
  if (squared.empty()) return std::nullopt;
  const auto top = std::ranges::max_element(squared);
  const double time = history.begin + (static_cast<double>(top - squared.begin()) + 0.5) * dt;
  if (longest_interval(history, time - period, time + period) * required_samples_per_cfc * cfc > 1 + 1e-9)
    return std::nullopt;
  return Peak{std::sqrt(*top), time};
}

}  // namespace

void IntervalHistory::append(double end, std::span<const double> sample) {
  ends.push_back(end);
  values.insert(values.end(), sample.begin(), sample.end());
}

std::vector<double> cfc_filter(std::span<const double> samples, double dt, int cfc) {
  if (samples.empty()) return {};
  // A held margin of one period of the class: the impulse response has died out to 1e-4 by then.
  const auto margin = static_cast<std::size_t>(std::ceil(1 / (cfc * dt)));
  std::vector<double> work(margin, samples.front());
  work.insert(work.end(), samples.begin(), samples.end());
  work.insert(work.end(), margin, samples.back());
  const Biquad filter = butterworth(dt, cfc);
  filter.run(work);
  std::ranges::reverse(work);
  filter.run(work);
  std::ranges::reverse(work);
  const auto first = work.begin() + static_cast<std::ptrdiff_t>(margin);
  return {first, first + static_cast<std::ptrdiff_t>(samples.size())};
}

std::vector<double> resample(const IntervalHistory& history, int channel, double dt) {
  std::vector<double> result;
  if (history.ends.empty()) return result;
  const auto count = static_cast<std::size_t>((history.ends.back() - history.begin) / dt * (1 + 1e-12));
  result.reserve(count);
  const auto value = [&](std::size_t i) {
    return history.values[i * static_cast<std::size_t>(history.channels) + static_cast<std::size_t>(channel)];
  };
  std::size_t i = 0;
  double from = history.begin;
  for (std::size_t k = 1; k <= count; ++k) {
    const double bin_end = history.begin + static_cast<double>(k) * dt;
    double integral = 0;
    const double bin_begin = from;
    while (i + 1 < history.ends.size() && history.ends[i] < bin_end) {
      integral += value(i) * (history.ends[i] - from);
      from = history.ends[i++];
    }
    integral += value(i) * (bin_end - from);
    from = bin_end;
    result.push_back(integral / (bin_end - bin_begin));
  }
  return result;
}

std::map<int, Peak> filtered_peaks(const IntervalHistory& history) {
  std::map<int, Peak> peaks;
  if (history.ends.empty()) return peaks;
  for (const int cfc : channel_frequency_classes)
    if (const auto peak = filtered_peak(history, cfc)) peaks.emplace(cfc, *peak);
  return peaks;
}

}  // namespace splashdown::apps
