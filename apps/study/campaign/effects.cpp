#include "apps/study/campaign/effects.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>

namespace splashdown::apps {
namespace {

/// The sign of a run in a set of factors: the product of theirs.
double sign(Factors high, Factors factors) { return std::popcount(factors & ~high) % 2 == 0 ? 1 : -1; }

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  const auto n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// Lenth's pseudo standard error: 1.5 times the median of those sizes that are below 2.5 times a first guess of it.
double lenth_error(const std::vector<Effect>& effects) {
  std::vector<double> sizes;
  for (const auto& effect : effects) sizes.push_back(std::abs(effect.value));
  const double guess = 1.5 * median_of(sizes);
  std::erase_if(sizes, [&](double size) { return guess > 0 && size >= 2.5 * guess; });
  return 1.5 * median_of(sizes);
}

/// One for each group of aliases, single factors first.
std::vector<Effect> candidates(std::size_t number, const Fraction& fraction) {
  std::vector<Effect> effects;
  const auto add = [&](Factors factors) {
    const auto aliases = fraction.aliases(factors, 2);
    const bool is_there = std::ranges::any_of(effects, [&](const Effect& effect) {
      return effect.factors == factors || std::ranges::find(aliases, effect.factors) != aliases.end();
    });
    if (!is_there && std::ranges::find(aliases, Factors{0}) == aliases.end())
      effects.push_back({.factors = factors, .value = 0, .standard_error = {}, .band = {}, .aliases = aliases});
  };
  for (std::size_t a = 0; a < number; ++a) add(Factors{1} << a);
  for (std::size_t a = 0; a < number; ++a)
    for (std::size_t b = a + 1; b < number; ++b) add(Factors{1} << a | Factors{1} << b);
  return effects;
}

}  // namespace

std::vector<Effect> effects_of(const std::vector<FactorialRun>& runs, std::size_t number, const Fraction& fraction) {
  auto effects = candidates(number, fraction);
  const auto rows = static_cast<Eigen::Index>(runs.size()), columns = static_cast<Eigen::Index>(effects.size()) + 1;
  if (effects.empty() || rows < columns) return {};
  Eigen::MatrixXd signs(rows, columns);
  Eigen::VectorXd found(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& run = runs[static_cast<std::size_t>(i)];
    found[i] = run.value;
    signs(i, 0) = 1;
    for (Eigen::Index k = 1; k < columns; ++k)
      signs(i, k) = sign(run.high, effects[static_cast<std::size_t>(k - 1)].factors);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(signs);
  if (solver.rank() < columns) return {};
  const Eigen::VectorXd halves = solver.solve(found);
  for (Eigen::Index k = 1; k < columns; ++k) effects[static_cast<std::size_t>(k - 1)].value = 2 * halves[k];

  const auto freedom = static_cast<double>(rows - columns);
  const double variance = freedom > 0 ? (found - signs * halves).squaredNorm() / freedom : 0;
  const Eigen::MatrixXd inverse = (signs.transpose() * signs).inverse();
  const bool by_lenth = freedom == 0 && effects.size() >= 3;
  const double lenth = by_lenth ? lenth_error(effects) : 0;
  for (Eigen::Index k = 1; k < columns; ++k) {
    auto& effect = effects[static_cast<std::size_t>(k - 1)];
    if (freedom > 0) effect.standard_error = 2 * std::sqrt(variance * inverse(k, k));
    if (by_lenth) effect.standard_error = lenth;
    if (!effect.standard_error) continue;
    // Lenth: a third of the number of effects as degrees of freedom.
    const double half = *effect.standard_error * student(by_lenth ? static_cast<double>(effects.size()) / 3 : freedom);
    effect.band = Band{effect.value - half, effect.value + half};
  }
  return effects;
}

}  // namespace splashdown::apps
