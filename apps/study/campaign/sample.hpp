// Statistics of one number over many runs, with bands.
#pragma once

#include <optional>
#include <vector>

namespace splashdown::apps {

struct Band {
  double low = 0, high = 0;
};

/// Of independent values; bands hold the true number in 95 % of all campaigns.
struct SampleStatistics {
  std::size_t runs = 0;
  double mean = 0, deviation = 0;  ///< deviation: of single values, n - 1 in its denominator; 0 for one value
  std::optional<Band> mean_band;   ///< Student's; from two values on
  double least = 0, most = 0;
  double share_5 = 0, quarter = 0, median = 0, three_quarters = 0, share_95 = 0;  ///< quantiles, linear between values
  std::optional<Band> median_band;  ///< between two of the values, whatever their distribution; from six values on
  std::optional<double> split;      ///< between two modes, where one is refuted; nothing: one mode will do
};

/// Statistics of values, at least one, all finite; in any order.
SampleStatistics statistics_of(std::vector<double> values);

/// Student's band of the mean; nothing for fewer than two values.
std::optional<Band> mean_band(const std::vector<double>& values);

/// Half-width of Student's band over the deviation of the mean, for this many degrees of freedom.
double student(double freedom);

/// Where sorted values have two modes: the deepest point between them. Told if their dip is larger than that of 95 % of uniform samples, of
/// all densities with one mode the flattest (Hartigan and Hartigan 1985). At least 20 values.
std::optional<double> two_modes(const std::vector<double>& values);

/// The probability of an event that occurred in `yes` of `runs` independent runs.
struct Probability {
  std::size_t yes = 0, runs = 0;
  double estimate() const { return static_cast<double>(yes) / static_cast<double>(runs); }
  /// Wilson's score band (1927): holds the true one in 95 % of campaigns on the average over probabilities.
  Band wilson() const;
  /// Clopper and Pearson's band (1934): holds it in at least 95 %, whatever it is.
  Band clopper_pearson() const;
};

}  // namespace splashdown::apps
