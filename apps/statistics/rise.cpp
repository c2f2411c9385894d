#include "apps/statistics/rise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace splashdown::apps {

namespace {

constexpr std::size_t most_windows = 20, steps_a_window = 2;
constexpr double grows_by = 0.01;  // from window to window

}  // namespace

bool rises_at_end(const IntervalHistory& history, double from, double to) {
  const auto& ends = history.ends;
  const auto first = static_cast<std::size_t>(std::ranges::upper_bound(ends, from) - ends.begin());
  const auto last =
      std::min(static_cast<std::size_t>(std::ranges::lower_bound(ends, to) - ends.begin()) + 1, ends.size());
  if (last < first + 2 || !(to > from)) return false;
  const auto windows = std::clamp((last - first) / steps_a_window, std::size_t{2}, most_windows);
  const double width = (to - from) / static_cast<double>(windows);
  std::vector<double> means(windows, 0.);
  std::size_t top = first;
  for (std::size_t i = first; i < last; ++i) {
    const double value = history.magnitude(i);
    if (value > history.magnitude(top)) top = i;
    for (std::size_t w = 0; w < windows; ++w) {
      const double begin = from + static_cast<double>(w) * width;
      means[w] += value / width * std::max(0., std::min(ends[i], begin + width) - std::max(history.begin_of(i), begin));
    }
  }
  const double before = *std::max_element(means.begin(), means.end() - 1);
  return means.back() > (1 + grows_by) * before && ends[top] > to - 2 * width;
}

}  // namespace splashdown::apps
