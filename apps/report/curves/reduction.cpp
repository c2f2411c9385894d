#include "apps/report/curves/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace splashdown::apps {

void thin(std::vector<double>& x, std::vector<double>& y, std::size_t limit) {
  if (x.size() <= limit || limit < 4) return;
  // Lowest and highest point of each of limit/2 groups, in their order.
  const std::size_t groups = limit / 2;
  std::vector<double> thin_x, thin_y;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t begin = g * x.size() / groups, end = (g + 1) * x.size() / groups;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (y[i] < y[low] || std::isnan(y[low])) low = i;
      if (y[i] > y[high] || std::isnan(y[high])) high = i;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (i == std::max(low, high) && low == high && !thin_x.empty() && thin_x.back() == x[i]) continue;
      thin_x.push_back(x[i]);
      thin_y.push_back(y[i]);
    }
  }
  if (thin_x.back() != x.back()) {
    thin_x.push_back(x.back());
    thin_y.push_back(y.back());
  }
  x = std::move(thin_x);
  y = std::move(thin_y);
}

void straighten(std::vector<double>& x, std::vector<double>& y, double tolerance) {
  constexpr double far = std::numeric_limits<double>::infinity();
  if (x.size() < 3) return;
  const auto number_first = [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; };
  const auto lowest = static_cast<std::size_t>(std::ranges::min_element(y, number_first) - y.begin());
  const auto highest = static_cast<std::size_t>(
      std::ranges::max_element(y, {}, [](double v) { return std::isnan(v) ? -far : v; }) - y.begin());
  std::size_t kept = 0;  // of the points that stay, the last
  double low = -far, high = far;
  for (std::size_t i = 1, from = 0; i < x.size(); ++i) {
    // From the last point that stays: slopes that pass all points since then near enough.
    const auto slope = [&](double to) { return (to - y[from]) / (x[i] - x[from]); };
    const double through = slope(y[i]);
    const bool straight = through >= low && through <= high;  // not so for nan, and where x stands still
    if ((!straight && i - 1 > from) || i - 1 == lowest || i - 1 == highest) {
      if (i - 1 > from) x[++kept] = x[i - 1], y[kept] = y[i - 1];
      from = i - 1;
      low = -far, high = far;
    }
    if (std::isnan(y[i]) || std::isnan(y[from])) {
      x[++kept] = x[i], y[kept] = y[i];
      from = i;
      low = -far, high = far;
      continue;
    }
    low = std::max(low, slope(y[i] - tolerance));
    high = std::min(high, slope(y[i] + tolerance));
  }
  if (x[kept] != x.back()) x[++kept] = x.back(), y[kept] = y.back();
  x.resize(kept + 1);
  y.resize(kept + 1);
}

}  // namespace splashdown::apps
