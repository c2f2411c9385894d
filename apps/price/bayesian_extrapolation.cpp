// Boost's 80-bit numbers, which it would use for doubles, are more than a band needs, and end a run under valgrind.
#define BOOST_MATH_PROMOTE_DOUBLE_POLICY false
#include "apps/price/bayesian_extrapolation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace splashdown::apps {
namespace {

/// Between the orders that are summed over (trapezoidal rule): bands move by a fiftieth with half of it.
constexpr double order_step = 0.1;
constexpr double negligible = 1e-4;  // of the likeliest pair's weight
constexpr int least_repeats = 6;
constexpr double one_size = 1.1;

/// Student's limits by degrees of freedom, which plans ask for thousands of times.
double limit_of(int freedom, double probability) {
  constexpr int normal = 200;  // to 1 %, the limits of a normal distribution
  static const auto table = [](double of) {
    std::vector<double> limits = {HUGE_VAL};
    for (int k = 1; k <= normal; ++k) limits.push_back(students_limit(k, of));
    return limits;
  };
  static const auto both_sides = table(0.95), one_side = table(0.9);
  return (probability == 0.95 ? both_sides : one_side)[static_cast<std::size_t>(std::clamp(freedom, 0, normal))];
}

}  // namespace

int sizes_of(std::span<const MeshValue> values) { return static_cast<int>(means_of_sizes(values).size()); }

bool are_repeated(std::span<const MeshValue> values) {
  return static_cast<int>(values.size()) - sizes_of(values) >= least_repeats;
}

std::vector<MeshValue> means_of_sizes(std::span<const MeshValue> values) {
  std::vector<MeshValue> sorted(values.begin(), values.end()), means;
  std::ranges::sort(sorted, {}, &MeshValue::h);
  for (std::size_t begin = 0, end; begin < sorted.size(); begin = end) {
    MeshValue mean{0, 0};
    for (end = begin; end < sorted.size() && sorted[end].h <= one_size * sorted[begin].h; ++end)
      mean.h += sorted[end].h, mean.value += sorted[end].value;
    const auto number = static_cast<double>(end - begin);
    means.push_back({mean.h / number, mean.value / number});
  }
  return means;
}

double students_limit(double freedom, double probability) {
  return boost::math::quantile(boost::math::students_t(freedom), 1 - (1 - probability) / 2);
}

BayesianExtrapolation::BayesianExtrapolation(std::span<const MeshValue> values, double lowest, double highest)
    : freedom_(static_cast<double>(values.size()) - 2) {
  const auto n = static_cast<Eigen::Index>(values.size());
  Eigen::VectorXd sizes(n), phi(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    sizes[i] = values[static_cast<std::size_t>(i)].h;
    phi[i] = values[static_cast<std::size_t>(i)].value;
  }
  mean_size_ = std::exp(sizes.array().log().mean());
  const double roundoff = 1e-12 * (phi.maxCoeff() - phi.minCoeff());
  std::vector<double> logarithms;
  repeated_ = are_repeated(values);
  for (int growth = 0; growth <= (repeated_ ? 6 : 2); ++growth) {
    const Eigen::VectorXd weights = (mean_size_ / sizes.array()).pow(growth);  // det W = 1
    for (int k = 0; lowest + k * order_step < highest + order_step / 2; ++k) {
      const double p = lowest + k * order_step;
      Eigen::MatrixX2d X(n, 2);
      X << Eigen::VectorXd::Ones(n), (sizes / mean_size_).array().pow(p).matrix();
      const Eigen::Matrix2d normal = X.transpose() * weights.asDiagonal() * X, inverse = normal.inverse();
      const Eigen::Vector2d solution = inverse * (X.transpose() * weights.cwiseProduct(phi));
      const double squares =
          weights.dot((phi - X * solution).cwiseAbs2()) + static_cast<double>(n) * roundoff * roundoff;
      const double variance = squares / freedom_;
      pairs_.push_back({.weight = 0,
                        .order = p,
                        .limit = solution[0],
                        .limit_error = std::sqrt(variance * inverse(0, 0)),
                        .middle = solution[1],
                        .middle_error = std::sqrt(variance * inverse(1, 1)),
                        .noise = std::sqrt(variance),
                        .growth = static_cast<double>(growth)});
      const bool at_end = p == lowest || p + order_step > highest + order_step / 2;
      logarithms.push_back(std::log(at_end ? 0.5 : 1.) - 0.5 * std::log(normal.determinant()) -
                           0.5 * freedom_ * std::log(squares));
    }
  }
  const double largest = *std::ranges::max_element(logarithms);
  const auto likeliest = std::ranges::find(logarithms, largest) - logarithms.begin();
  if (repeated_) lack_of_fit_ = lack_of_fit(pairs_[static_cast<std::size_t>(likeliest)], values);
  for (std::size_t i = 0; i < pairs_.size(); ++i) pairs_[i].weight = std::exp(logarithms[i] - largest);
  std::erase_if(pairs_, [](const Pair& pair) { return pair.weight < negligible; });
  double sum = 0;
  for (const auto& pair : pairs_) sum += pair.weight;
  for (auto& pair : pairs_) pair.weight /= sum;
}

double BayesianExtrapolation::lack_of_fit(const Pair& pair, std::span<const MeshValue> values) const {
  const auto weight = [&](double h) { return std::pow(h / mean_size_, -pair.growth); };
  const auto means = means_of_sizes(values);
  const auto sizes = static_cast<double>(means.size());
  double lack = 0, within_sizes = 0;
  for (const auto& [h, value] : values) {
    const auto& mean = *std::ranges::min_element(
        means, {}, [h = h](const MeshValue& other) { return std::abs(std::log(other.h / h)); });
    const double law = pair.limit + pair.middle * std::pow(mean.h / mean_size_, pair.order);
    lack += weight(h) * (mean.value - law) * (mean.value - law);
    within_sizes += weight(h) * (value - mean.value) * (value - mean.value);
  }
  if (sizes < 3 || within_sizes == 0) return 0;
  const double many = static_cast<double>(values.size()) - sizes;
  return cdf(boost::math::fisher_f(sizes - 2, many), lack / (sizes - 2) * many / within_sizes);
}

double BayesianExtrapolation::quantile(const std::vector<Part>& parts, double freedom, double probability) {
  const boost::math::students_t t(freedom);
  const auto missing = [&](double b) {
    double inside = 0;
    for (const auto& [weight, mean, scale] : parts)
      inside += weight * (cdf(t, (b - mean) / scale) - cdf(t, (-b - mean) / scale));
    return inside - probability;
  };
  const double far = students_limit(freedom, probability);
  double high = 0;  // each part lies within with more than the probability
  for (const auto& part : parts) high = std::max(high, std::abs(part.mean) + far * part.scale);
  if (!(missing(high) > 0)) return high;
  std::uintmax_t steps = 100;
  const auto precise = [](double a, double b) { return b - a <= 1e-6 * b; };
  return boost::math::tools::toms748_solve(missing, 0., high, precise, steps).second;
}

double BayesianExtrapolation::within(double value, double probability) const {
  std::vector<Part> parts;
  for (const auto& pair : pairs_) parts.push_back({pair.weight, pair.limit - value, pair.limit_error});
  return quantile(parts, freedom_, probability);
}

double BayesianExtrapolation::within_of_one_at(double h, double probability) const {
  std::vector<Part> parts;
  for (const auto& pair : pairs_) {
    const double relative = h / mean_size_, power = std::pow(relative, pair.order);
    const double noise = pair.noise * std::pow(relative, 0.5 * pair.growth);
    parts.push_back({pair.weight, pair.middle * power, std::hypot(pair.middle_error * power, noise)});
  }
  return quantile(parts, freedom_, probability);
}

BayesianExtrapolation::Part BayesianExtrapolation::of_mean(const Pair& pair, std::span<const RunsOfSize> runs,
                                                           std::size_t mean) const {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  const auto row = [&](double h) { return Eigen::Vector2d(1, std::pow(h / mean_size_, pair.order)); };
  const auto variance = [&](double h) { return std::pow(h / mean_size_, pair.growth); };
  for (const auto& [h, number] : runs) normal += number / variance(h) * row(h) * row(h).transpose();
  const Eigen::Matrix2d inverse = normal.inverse();
  const auto& [h, number] = runs[mean];
  // Of the fit's phi_0 less the mean, which is one of the values that it is fitted to.
  const double scatter = inverse(0, 0) + variance(h) / number - 2 * inverse.row(0).dot(row(h));
  const double bias = pair.middle * row(h)[1], spread = pair.noise * std::sqrt(std::max(scatter, 0.));
  return {pair.weight, std::hypot(bias, spread), pair.noise * std::sqrt(inverse(0, 0))};
}

double BayesianExtrapolation::within_of_mean(std::span<const RunsOfSize> runs, std::size_t mean) const {
  double centre = 0, scale = 0;
  int number = 0;
  for (const auto& of_size : runs) number += of_size.runs;
  for (const auto& pair : pairs_) {
    const auto part = of_mean(pair, runs, mean);
    centre += part.weight * part.mean * part.mean;
    scale += part.weight * part.scale * part.scale;
  }
  centre = std::sqrt(centre), scale = std::sqrt(scale);
  // Far from the centre one side of the odds is left out, near it both: what is larger is the half-width to a tenth.
  return std::max(limit_of(number - 2, 0.95) * scale, centre + limit_of(number - 2, 0.9) * scale);
}

double BayesianExtrapolation::error(double h) const {
  double sum = 0;
  for (const auto& pair : pairs_) sum += pair.weight * std::abs(pair.middle) * std::pow(h / mean_size_, pair.order);
  return sum;
}

double BayesianExtrapolation::noise(double h) const {
  double variance = 0;
  for (const auto& pair : pairs_)
    variance += pair.weight * pair.noise * pair.noise * std::pow(h / mean_size_, pair.growth);
  return std::sqrt(variance);
}

}  // namespace splashdown::apps
