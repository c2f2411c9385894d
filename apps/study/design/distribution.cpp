#include "apps/study/design/distribution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <cmath>
#include <limits>

namespace splashdown::apps {
namespace {

/// Mean and standard deviation of the logarithm of a lognormal value with this mean and deviation.
boost::math::lognormal lognormal_of(double mean, double deviation) {
  const double variance = std::log1p(std::pow(deviation / mean, 2));
  return {std::log(mean) - variance / 2, std::sqrt(variance)};
}

double table_quantile(const Distribution& d, double u) {
  const auto above = std::ranges::upper_bound(d.below, u);
  const auto k = std::clamp<std::ptrdiff_t>(above - d.below.begin(), 1, std::ssize(d.below) - 1);
  const auto i = static_cast<std::size_t>(k);
  return d.values[i - 1] + (d.values[i] - d.values[i - 1]) * (u - d.below[i - 1]) / (d.below[i] - d.below[i - 1]);
}

double table_share(const Distribution& d, double x) {
  if (x <= d.values.front()) return 0;
  if (x >= d.values.back()) return 1;
  const auto i = static_cast<std::size_t>(std::ranges::upper_bound(d.values, x) - d.values.begin());
  return d.below[i - 1] + (d.below[i] - d.below[i - 1]) * (x - d.values[i - 1]) / (d.values[i] - d.values[i - 1]);
}

/// Of a distribution of Boost's that is not cut off.
template <class Boost>
double of(const Boost& distribution, bool inverse, double argument) {
  if (inverse) return boost::math::quantile(distribution, argument);
  const auto [low, high] = boost::math::support(distribution);
  if (argument <= low) return 0;
  return argument >= high ? 1 : boost::math::cdf(distribution, argument);
}

/// The quantile of a share, or, the other way round, the share below a value.
double evaluated(const Distribution& d, bool inverse, double argument) {
  using enum Distribution::Type;
  const double a = d.first, b = d.second;
  switch (d.type) {
    case uniform:
      return inverse ? a + argument * (b - a) : std::clamp((argument - a) / (b - a), 0., 1.);
    case log_uniform:
      if (inverse) return a * std::pow(b / a, argument);
      return argument <= a ? 0 : std::min(1., std::log(argument / a) / std::log(b / a));
    case normal:
      return of(boost::math::normal(a, b), inverse, argument);
    case lognormal:
      return of(lognormal_of(a, b), inverse, argument);
    case weibull:
      return of(boost::math::weibull(a, b), inverse, argument);
    case table:
      break;
  }
  return inverse ? table_quantile(d, argument) : table_share(d, argument);
}

bool is_ascending(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::greater_equal<>()) == values.end();
}

std::string fault_of_table(const Distribution& d) {
  if (d.values.size() < 2) return "needs two values or more";
  if (d.below.size() != d.values.size()) return "needs as many shares as values";
  if (!is_ascending(d.values)) return "needs values that ascend";
  if (!is_ascending(d.below) || d.below.front() != 0 || d.below.back() != 1)
    return "needs shares that ascend from 0 to 1: how much of all lies below each value";
  return {};
}

}  // namespace

void Distribution::set(Part part, double value) {
  switch (part) {
    case Part::first:
      first = value;
      break;
    case Part::second:
      second = value;
      break;
    case Part::least:
      least = value;
      break;
    case Part::most:
      most = value;
      break;
  }
}

double quantile(const Distribution& distribution, double u) {
  const double low = distribution.least ? evaluated(distribution, false, *distribution.least) : 0;
  const double high = distribution.most ? evaluated(distribution, false, *distribution.most) : 1;
  const double smallest = std::numeric_limits<double>::epsilon() / 2;  // beside 1
  const double share = std::clamp(low + u * (high - low), smallest, 1 - smallest);
  double value = evaluated(distribution, true, share);
  if (distribution.least) value = std::max(value, *distribution.least);
  if (distribution.most) value = std::min(value, *distribution.most);
  return value;
}

double mean_of(const Distribution& distribution) {
  constexpr int shares = 1000;
  double sum = 0;
  for (int i = 0; i < shares; ++i) sum += quantile(distribution, (i + 0.5) / shares);
  return sum / shares;
}

std::string fault_of(const Distribution& d) {
  using enum Distribution::Type;
  if (d.type == table) return fault_of_table(d);
  for (const double number : {d.first, d.second, d.least.value_or(0), d.most.value_or(0)})
    if (!std::isfinite(number)) return "needs numbers that are finite";
  if ((d.type == uniform || d.type == log_uniform) && !(d.first < d.second))
    return "needs a lowest value below the highest";
  if (d.type == log_uniform && !(d.first > 0)) return "needs positive values";
  if (d.type == normal && !(d.second > 0)) return "needs a positive standard deviation, sd";
  if (d.type == lognormal && !(d.first > 0 && d.second > 0))
    return "needs a positive mean and a positive standard deviation, sd";
  if (d.type == weibull && !(d.first > 0 && d.second > 0)) return "needs a positive shape and a positive scale";
  const double low = d.least ? evaluated(d, false, *d.least) : 0, high = d.most ? evaluated(d, false, *d.most) : 1;
  constexpr double least_share = 1e-12;  // with less, shares of doubles leave fewer than four digits
  if (!(high - low > least_share)) return "leaves nothing between min and max";
  return {};
}

}  // namespace splashdown::apps
