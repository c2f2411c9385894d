#include "apps/statistics/filters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

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

/// A held margin of one period of the class: the impulse response has died out to 1e-4 by then.
std::size_t margin_samples(double dt, int cfc) { return static_cast<std::size_t>(std::ceil(1 / (cfc * dt) - 1e-9)); }

std::vector<double> filtered_with_margins(std::span<const double> samples, double dt, int cfc) {
  if (samples.empty()) return {};
  const std::size_t margin = margin_samples(dt, cfc);
  std::vector<double> work(margin, samples.front());
  work.insert(work.end(), samples.begin(), samples.end());
  work.insert(work.end(), margin, samples.back());
  const Biquad filter = butterworth(dt, cfc);
  filter.run(work);
  std::ranges::reverse(work);
  filter.run(work);
  std::ranges::reverse(work);
  return work;
}

/// Longest interval within 1/CFC of a time.
double longest_interval(const IntervalHistory& history, int cfc, double time) {
  const double from = time - 1.0 / cfc, to = time + 1.0 / cfc;
  const auto& ends = history.ends;
  double longest = 0;
  for (std::size_t i = static_cast<std::size_t>(std::ranges::lower_bound(ends, from) - ends.begin()); i < ends.size();
       ++i) {
    const double begin = i == 0 ? history.begin : ends[i - 1];
    if (begin > to) break;
    longest = std::max(longest, ends[i] - begin);
  }
  return longest;
}

/// Of the mean over an interval from the line through two others.
double deviation(const IntervalHistory& history, std::size_t i, std::size_t a, std::size_t b) {
  const auto n = static_cast<std::size_t>(history.channels);
  const double share = (history.middle_of(i) - history.middle_of(a)) / (history.middle_of(b) - history.middle_of(a));
  double squared = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto value = [&](std::size_t j) { return history.values[j * n + k]; };
    const double off = value(i) - value(a) - share * (value(b) - value(a));
    squared += off * off;
  }
  return std::sqrt(squared);
}

}  // namespace

double IntervalHistory::magnitude(std::size_t i) const {
  const auto n = static_cast<std::size_t>(channels);
  double squared = 0;
  for (std::size_t k = 0; k < n; ++k) squared += values[i * n + k] * values[i * n + k];
  return std::sqrt(squared);
}

void IntervalHistory::append(double end, std::span<const double> sample) {
  if (sample.size() != static_cast<std::size_t>(channels) || values.size() != ends.size() * sample.size())
    throw std::runtime_error("a history of other channels than its samples");
  ends.push_back(end);
  values.insert(values.end(), sample.begin(), sample.end());
}

std::vector<double> cfc_filter(std::span<const double> samples, double dt, int cfc) {
  const auto work = filtered_with_margins(samples, dt, cfc);
  if (work.empty()) return {};
  const auto first = work.begin() + static_cast<std::ptrdiff_t>(margin_samples(dt, cfc));
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

std::optional<IntervalHistory> filtered(const IntervalHistory& history, int cfc) {
  if (history.ends.empty()) return std::nullopt;
  const double span = history.ends.back() - history.begin, period = 1.0 / cfc;
  if (span < period) return std::nullopt;
  const double dt = 1 / (samples_per_cfc * cfc);
  constexpr double most = 2e7;  // samples: a gigabyte with its margins and copies
  if (span / dt * history.channels > most) return std::nullopt;
  const auto channels = static_cast<std::size_t>(history.channels);
  const double begin = history.begin - static_cast<double>(margin_samples(dt, cfc)) * dt;
  IntervalHistory result{history.channels, begin, {}, {}};
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const auto samples = filtered_with_margins(resample(history, static_cast<int>(channel), dt), dt, cfc);
    result.values.resize(samples.size() * channels);
    for (std::size_t i = 0; i < samples.size(); ++i) result.values[i * channels + channel] = samples[i];
  }
  if (result.values.empty()) return std::nullopt;
  for (std::size_t i = 0; i * channels < result.values.size(); ++i)
    result.ends.push_back(begin + static_cast<double>(i + 1) * dt);
  return result;
}

bool fine_enough(const IntervalHistory& history, int cfc, double time) {
  return longest_interval(history, cfc, time) * required_samples_per_cfc * cfc <= 1 + 1e-9;
}

double lost_to_steps(const IntervalHistory& history, int cfc, double time) {
  const double x = std::numbers::pi * std::min(1., longest_interval(history, cfc, time) * cfc / 0.6);
  return x > 0 ? 1 - std::sin(x) / x : 0;
}

double roughness(const IntervalHistory& history, int cfc, double time) {
  const auto& ends = history.ends;
  if (ends.size() < 3) return std::numeric_limits<double>::infinity();
  const std::size_t last = ends.size() - 1;
  double largest = 0;
  for (auto i = static_cast<std::size_t>(std::ranges::lower_bound(ends, time - 1.0 / cfc) - ends.begin()); i <= last;
       ++i) {
    if ((i == 0 ? history.begin : ends[i - 1]) > time + 1.0 / cfc) break;
    if (i == 0 || i == last)  // the line goes on beyond the two beside it
      largest = std::max(largest, i == 0 ? deviation(history, i, 1, 2) : deviation(history, i, last - 2, last - 1));
    else
      largest = std::max(largest, 2 * deviation(history, i, i - 1, i + 1));
  }
  return largest;
}

}  // namespace splashdown::apps
