// Distributions of random axes, as quantiles: the value below which a share of all values lies.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

/// The quantile Q(u) of a continuous distribution, monotonic in the share u of [0, 1).
struct Distribution {
  enum class Type { uniform, log_uniform, normal, lognormal, weibull, table };
  Type type = Type::uniform;
  /// uniform, log_uniform: lowest and highest value. normal, lognormal: mean and standard deviation of the value itself.
  /// weibull: shape k and scale, P(X > x) = exp(-(x/scale)^k).
  double first = 0, second = 1;
  std::vector<double> values, below;  ///< table: values and the shares of all below them, from 0 to 1, linear between
  std::optional<double> least, most;  ///< cut off there: what is outside never occurs

  enum class Part { first, second, least, most };
  /// Sets one of its numbers.
  void set(Part part, double value);
};

/// Value below which the share `u` of all values lies. `u` is in [0, 1); 0 stands for the smallest share that doubles tell from it.
double quantile(const Distribution& distribution, double u);

/// Mean of what is drawn, by 1000 equal shares; for messages and tests.
double mean_of(const Distribution& distribution);

/// What is wrong with its numbers; empty: nothing.
std::string fault_of(const Distribution& distribution);

}  // namespace splashdown::apps
