// Where the limit of a ladder of noisy values may be.
//
//   phi_i = phi_0 + alpha h_i^p + e_i,   e_i normal with variance s^2 g(h_i),   g = 1, h/H or (h/H)^2
//
// H is the geometric mean of the sizes. Before any value is known each order p between two ends is as likely as another, each
// law of noise too, and phi_0, alpha H^p and log s may be anything. Then, given p and g, phi_0 follows Student's t
// with n - 2 degrees of freedom about its least-squares value, with its standard error; and a pair (p, g) has the weight
// det(X^T W X)^(-1/2) S^(-(n-2)/2) det(W)^(1/2), with the weighted sum of squares S (Gelman et al. 2013, Bayesian Data Analysis, section 14.2,
// integrated over the coefficients and s). The odds of phi_0 are the weighted sum over the pairs.
// Where sizes have runs enough to tell their scatter apart (`are_repeated`), g may be (h/H)^3 to (h/H)^6 as well, and whether any order
// fits their means is a question with an answer (lack-of-fit test, Draper and Smith 1998, section 2.1).
#pragma once

#include <span>
#include <vector>

#include "apps/price/mesh_value.hpp"

namespace splashdown::apps {

/// Runs on meshes of one size, each another mesh.
struct RunsOfSize {
  double h;  ///< element size, relative
  int runs;
};

/// Values at sizes within 10 % of each other are of one size.
int sizes_of(std::span<const MeshValue> values);
/// Whether six values or more are beside the first of their size: with fewer a standard deviation is known to a third at best.
bool are_repeated(std::span<const MeshValue> values);
/// The mean of the values of each size at the mean of their h.
std::vector<MeshValue> means_of_sizes(std::span<const MeshValue> values);

/// Student's t, two-sided: |t| is not above it with this probability.
double students_limit(double freedom, double probability);

class BayesianExtrapolation {
 public:
  /// At least four values, of three sizes or more, not all the same. Orders from `lowest` to `highest`.
  BayesianExtrapolation(std::span<const MeshValue> values, double lowest, double highest);

  /// The distance from a value of the ladder within which phi_0 lies with this probability.
  double within(double value, double probability) const;
  /// The same for a value that is still to be measured at h; never less at a larger h.
  double within_of_one_at(double h, double probability) const;
  /// What `within` is expected to give, with 95 %, about the mean of the runs of one of these sizes once all of them are made: if the
  /// coefficients are what they are taken for now, its centre is alpha h^p and the scatter of phi_0 about that mean, and its scale that
  /// of the fit. For plans: centres and scales of all pairs are put together by their squares.
  double within_of_mean(std::span<const RunsOfSize> runs, std::size_t mean) const;
  /// How surely the means of the sizes lie farther from the likeliest law than their own scatter explains: the probability of a smaller
  /// lack of fit if there were none. 0 where values are not repeated.
  double lack_of_fit() const { return lack_of_fit_; }
  bool is_of_repeated() const { return repeated_; }
  /// |alpha h^p|, the mean over the odds.
  double error(double h) const;
  /// Standard deviation between meshes of this size, as the values have it.
  double noise(double h) const;

 private:
  /// Student's t about a mean with a scale.
  struct Part {
    double weight, mean, scale;
  };
  /// The least b with P(|x| <= b) = probability for the sum of the parts, each with these degrees of freedom.
  static double quantile(const std::vector<Part>& parts, double freedom, double probability);

  struct Pair {
    double weight, order, limit, limit_error, middle, middle_error, noise;  // middle: alpha H^p
    double growth;                                                          // g = (h/H)^growth
  };
  double lack_of_fit(const Pair& pair, std::span<const MeshValue> values) const;
  Part of_mean(const Pair& pair, std::span<const RunsOfSize> runs, std::size_t mean) const;
  std::vector<Pair> pairs_;
  double mean_size_, freedom_;
  bool repeated_ = false;
  double lack_of_fit_ = 0;
};

}  // namespace splashdown::apps
