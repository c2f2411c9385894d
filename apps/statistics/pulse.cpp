#include "apps/statistics/pulse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splashdown::apps {

namespace {

constexpr double foot = 0.1, shoulder = 0.9;  // of the peak; ISO 2041

/// One channel: averages over intervals.
struct Channel {
  const IntervalHistory& history;
  std::vector<double> values;

  double begin(std::size_t i) const { return i == 0 ? history.begin : history.ends[i - 1]; }
  double middle(std::size_t i) const { return 0.5 * (begin(i) + history.ends[i]); }
  /// Where the line between the middles of i and i + 1 meets `level`.
  double crossing(std::size_t i, double level) const {
    const double share = (level - values[i]) / (values[i + 1] - values[i]);
    return middle(i) + share * (middle(i + 1) - middle(i));
  }
  double integral(double from, double to) const {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += values[i] * std::max(0.0, std::min(to, history.ends[i]) - std::max(from, begin(i)));
    return sum;
  }
};

std::size_t peak_index(const IntervalHistory& history, double from, double to) {
  const auto n = static_cast<std::size_t>(history.channels);
  std::size_t top = history.ends.size();
  double largest = -1;
  for (std::size_t i = 0; i < history.ends.size(); ++i) {
    const double middle = 0.5 * ((i == 0 ? history.begin : history.ends[i - 1]) + history.ends[i]);
    if (middle < from || middle > to) continue;
    double squared = 0;
    for (std::size_t k = 0; k < n; ++k) squared += history.values[i * n + k] * history.values[i * n + k];
    if (squared > largest) largest = squared, top = i;
  }
  return top;
}

Channel along_peak(const IntervalHistory& history, std::size_t top) {
  const auto n = static_cast<std::size_t>(history.channels);
  const double* direction = &history.values[top * n];
  double length = 0;
  for (std::size_t k = 0; k < n; ++k) length += direction[k] * direction[k];
  length = std::sqrt(length);
  Channel channel{history, {}};
  channel.values.reserve(history.ends.size());
  for (std::size_t i = 0; i < history.ends.size(); ++i) {
    double c = 0;
    for (std::size_t k = 0; k < n; ++k) c += history.values[i * n + k] * direction[k];
    channel.values.push_back(length > 0 ? c / length : 0);
  }
  return channel;
}

}  // namespace

Pulse pulse_of(const IntervalHistory& history, double from, double to) {
  Pulse pulse;
  const std::size_t top = peak_index(history, from, to);
  if (top == history.ends.size()) return pulse;
  const Channel channel = along_peak(history, top);
  const auto& c = channel.values;
  pulse.offer(c[top], channel.middle(top));
  const double low = foot * c[top], high = shoulder * c[top];
  if (!(c[top] > 0)) return pulse;

  std::size_t first = top;  // the interval before the pulse's first one, if there is one
  while (first > 0 && c[first] >= low) --first;
  if (c[first] >= low) return pulse;
  const double begin = pulse.begin = channel.crossing(first, low);
  std::size_t risen = first;
  while (c[risen + 1] < high) ++risen;
  pulse.rise_time = channel.crossing(risen, high) - begin;

  std::size_t last = top;
  while (last + 1 < c.size() && c[last + 1] >= low) ++last;
  if (last + 1 == c.size()) return pulse;
  const double end = channel.crossing(last, low);
  pulse.duration = end - begin;
  pulse.change = channel.integral(begin, end);
  return pulse;
}

std::map<int, Pulse> filtered_pulses(const IntervalHistory& history) {
  std::map<int, Pulse> pulses;
  for (const int cfc : channel_frequency_classes) {
    const auto channels = filtered(history, cfc);
    if (!channels) continue;
    const Pulse pulse = pulse_of(*channels, history.begin, history.ends.back());
    if (pulse.time < 0) continue;
    if (cfc == structures_class || fine_enough(history, cfc, pulse.time)) pulses.emplace(cfc, pulse);
  }
  return pulses;
}

}  // namespace splashdown::apps
