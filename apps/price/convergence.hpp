// What a ladder of meshes says about a value: order, extrapolation and band by least squares.
//
//   phi(h) = phi_0 + alpha h^p,  p unknown, 1 or 2,   or   phi_0 + alpha_1 h + alpha_2 h^2
//   U(h_i) = F (eps + sigma + |phi_i - fit|)                  h: element size over that of refine = 1 [-]
//
// with eps = |fit - phi_0| and sigma the standard deviation of the fit. Each form is fitted with equal weights and with
// weights 1/h; the fit with the least sigma counts: with an order in [0.5, 2.1) the one of unknown order, above first or
// second order, below all three. Where sigma is below Delta = (max phi - min phi)/(rungs - 1), F multiplies eps alone, 1.25
// with such an order and 3 without; elsewhere the data scatter and F = 3.
// Eca and Hoekstra (2014), J. Comput. Phys. 262, 104-130, whose bands are meant for 95 % of cases. With two changes:
// - Meshes more than eight times as coarse as the finest do not count where four others are there.
// - With more than three values U is that distance within which the limit lies with 95 %, as long as an order in [0.5, 2] is
//   possible: (n - 3)(S_p/S - 1) <= t^2 with S the least sum of squares of any order and t Student's (BayesianExtrapolation); where an
//   order is found, and 0.25 eps, as their F has it for what the form itself gets wrong. Their rule for data that scatter, F = 3 sigma/Delta, gives
//   mere noise 9 standard deviations with four meshes and 15 with twelve; fits of three coefficients follow the noise, and
//   what they say of the limit is then taken three times; and of noisy series with an order it leaves one true value in
//   four outside.
// - Where runs are repeated on meshes of equal size, their means show what single values hide. If no order fits them (BayesianExtrapolation),
//   the coarsest size is left out, as long as four are there; and if none fits those either, the means count as one value each.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "apps/price/bayesian_extrapolation.hpp"
#include "apps/price/mesh_value.hpp"

namespace splashdown::apps {

enum class Form { unknown_order, first_order, second_order, first_and_second_order };

class Convergence {
 public:
  /// Nothing with fewer than three sizes or a value that is not finite. Values at sizes within 10 % of each other are
  /// replicates: they count in the fit and are one rung.
  static std::optional<Convergence> of(std::span<const MeshValue> values);

  Form form() const { return form_; }
  /// Of the fit; absent: none in the asymptotic range.
  std::optional<double> order() const { return order_; }
  /// Why there is no order; empty: there is one.
  const std::string& refusal() const { return refusal_; }
  double extrapolated() const { return limit_; }  ///< phi_0, Richardson's value
  double deviation() const { return deviation_; }
  bool scattered() const { return deviation_ >= range_; }
  double fitted(double h) const;
  double error(double h) const;  ///< eps; never less at a larger h
  /// Of a value measured at h, and of one that is still to be measured there.
  double band(const MeshValue& measured) const;
  double band(double h) const;
  /// What the band of the mean of the runs of one of these sizes is expected to be once all of them are made; nothing where the odds of
  /// the limit do not rule the band.
  std::optional<double> band_of_mean(std::span<const RunsOfSize> runs, std::size_t mean) const;
  /// Standard deviation between meshes of this size, by the odds.
  std::optional<double> noise(double h) const;

 private:
  double usual_band(double h, double beside) const;  ///< of the paper, but for the factor of scattered data
  double of_the_model(double h) const;               ///< (1.25 - 1) eps where there is an order

  Form form_ = Form::first_order;
  std::optional<double> order_;
  std::string refusal_;
  double limit_ = 0, first_ = 0, second_ = 0;  // coefficients of h^exponent and, in the last form, of h^2
  bool weighted_ = false;
  double coarsest_ = HUGE_VAL;   // size of those that count
  bool follows_no_law_ = false;  // of repeated runs
  std::optional<BayesianExtrapolation> extrapolation_;
  double exponent_ = 1, deviation_ = 0, range_ = 0, safety_ = 3;

  friend class Fitter;
};

}  // namespace splashdown::apps
