// Boost's 80-bit numbers, which it would use for doubles, are more than a band needs, and end a run under valgrind.
#define BOOST_MATH_PROMOTE_DOUBLE_POLICY false
#include "apps/price/bayesian_extrapolation.hpp"

#include <Eigen/Dense>
#include <algorithm>
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

}  // namespace

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
  for (const double growth : {0., 1., 2.}) {
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
                        .growth = growth});
      const bool at_end = p == lowest || p + order_step > highest + order_step / 2;
      logarithms.push_back(std::log(at_end ? 0.5 : 1.) - 0.5 * std::log(normal.determinant()) -
                           0.5 * freedom_ * std::log(squares));
    }
  }
  const double largest = *std::ranges::max_element(logarithms);
  for (std::size_t i = 0; i < pairs_.size(); ++i) pairs_[i].weight = std::exp(logarithms[i] - largest);
  std::erase_if(pairs_, [](const Pair& pair) { return pair.weight < negligible; });
  double sum = 0;
  for (const auto& pair : pairs_) sum += pair.weight;
  for (auto& pair : pairs_) pair.weight /= sum;
}

double BayesianExtrapolation::quantile(const std::vector<Part>& parts, double probability) const {
  const boost::math::students_t t(freedom_);
  const auto missing = [&](double b) {
    double inside = 0;
    for (const auto& [weight, mean, scale] : parts)
      inside += weight * (cdf(t, (b - mean) / scale) - cdf(t, (-b - mean) / scale));
    return inside - probability;
  };
  const double far = students_limit(freedom_, probability);
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
  return quantile(parts, probability);
}

double BayesianExtrapolation::within_of_one_at(double h, double probability) const {
  std::vector<Part> parts;
  for (const auto& pair : pairs_) {
    const double relative = h / mean_size_, power = std::pow(relative, pair.order);
    const double noise = pair.noise * std::pow(relative, 0.5 * pair.growth);
    parts.push_back({pair.weight, pair.middle * power, std::hypot(pair.middle_error * power, noise)});
  }
  return quantile(parts, probability);
}

}  // namespace splashdown::apps
