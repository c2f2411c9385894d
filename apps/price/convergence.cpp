#include "apps/price/convergence.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/dense.hpp"

namespace splashdown::apps {
namespace {

// Of the paper, section 4: orders below count as none, orders from 2.1 on as higher than a second-order method has.
constexpr double least_order = 0.5, highest_order = 2, order_too_high = 2.1;
constexpr double good_safety = 1.25, poor_safety = 3;
constexpr double sure = 0.95;
constexpr double doubted = 0.75;  // a lack of fit that the coarsest mesh is taken to be the cause of

/// Meshes with elements beyond this many times the finest's tell little of its error, where enough others are there.
constexpr double coarsest_that_counts = 8.08;  // refinements are rounded
constexpr int rungs_that_count = 4;
constexpr double same_to = 1.05;  // of one size: half of what tells sizes apart

/// Without those on too coarse meshes.
std::vector<MeshValue> that_count(std::span<const MeshValue> values) {
  const double finest = std::ranges::min_element(values, {}, &MeshValue::h)->h;
  std::vector<MeshValue> sorted(values.begin(), values.end()), counting;
  std::ranges::sort(sorted, {}, &MeshValue::h);
  for (const auto& value : sorted)
    if (value.h <= coarsest_that_counts * finest || sizes_of(counting) < rungs_that_count) counting.push_back(value);
  return counting;
}

/// Of repeated runs: sizes that no order fits, from the coarsest on, and if that is all of them their scatter. Whether one fits.
bool leave_out_lawless(std::vector<MeshValue>& values) {  // ascending in h
  while (are_repeated(values)) {
    const double lack = BayesianExtrapolation(values, least_order, highest_order).lack_of_fit();
    const bool may_be_coarser = sizes_of(values) > rungs_that_count;
    if (lack < (may_be_coarser ? doubted : sure)) return true;
    if (!may_be_coarser) {
      values = means_of_sizes(values);
      return false;
    }
    const double coarsest = means_of_sizes(values).back().h;
    std::erase_if(values, [&](const MeshValue& value) { return value.h > coarsest / same_to; });
  }
  return true;
}

// The search for the order: beyond these ends h^p is a constant, or nothing but the coarsest mesh.
constexpr double search_from = 0.02, search_to = 10;
constexpr int search_points = 500;

double sum_of_squares(const Eigen::VectorXd& weights, const Eigen::VectorXd& residual) {
  return weights.dot(residual.cwiseAbs2());
}

}  // namespace

/// All fits of one set of values.
class Fitter {
 public:
  explicit Fitter(std::span<const MeshValue> values)
      : values_(values), h_(values.size()), phi_(values.size()), rungs_(sizes_of(values)) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      h_[static_cast<Eigen::Index>(i)] = values[i].h;
      phi_[static_cast<Eigen::Index>(i)] = values[i].value;
    }
    equal_ = Eigen::VectorXd::Constant(h_.size(), 1. / static_cast<double>(h_.size()));
    fine_ = h_.cwiseInverse() / h_.cwiseInverse().sum();
  }

  Convergence best() {
    std::vector<Convergence> fits;
    std::string refusal = "three meshes are too few for an order";
    if (h_.size() > 3) fits = with_order(refusal);
    if (fits.empty()) fits = without_order(any_too_low_);
    auto best = *std::ranges::min_element(fits, {}, &Convergence::deviation_);
    if (!best.order_) best.refusal_ = refusal;
    if (likeliest_ && likeliest_->deviation_ > 0 && an_order_is_possible())
      best.extrapolation_.emplace(values_, least_order, highest_order);
    best.range_ = (phi_.maxCoeff() - phi_.minCoeff()) / (rungs_ - 1);
    best.safety_ = best.order_ && !best.scattered() ? good_safety : poor_safety;
    return best;
  }

 private:
  /// Linear in its coefficients: exponents of h beside the constant. Infinite deviation without a degree of freedom left.
  Convergence fit(Form form, const Eigen::VectorXd& weights, std::vector<double> exponents) const {
    const auto columns = static_cast<Eigen::Index>(exponents.size()) + 1;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(h_.size(), columns);
    for (Eigen::Index k = 1; k < columns; ++k)
      matrix.col(k) = h_.array().pow(exponents[static_cast<std::size_t>(k - 1)]);
    const Eigen::VectorXd root = weights.cwiseSqrt();
    const Eigen::VectorXd solution = algebra::least_squares(root.asDiagonal() * matrix, root.cwiseProduct(phi_));
    Convergence result;
    result.form_ = form;
    result.limit_ = solution[0];
    result.first_ = solution[1];
    result.exponent_ = exponents.front();
    if (columns > 2) result.second_ = solution[2];
    const auto parameters = columns + (form == Form::unknown_order ? 1 : 0);
    const double n = static_cast<double>(h_.size()), free = n - static_cast<double>(parameters);
    result.deviation_ = free > 0 ? std::sqrt(n * sum_of_squares(weights, matrix * solution - phi_) / free)
                                 : std::numeric_limits<double>::infinity();
    return result;
  }

  Convergence fit_of_order(const Eigen::VectorXd& weights, double p) const {
    return fit(Form::unknown_order, weights, {p});
  }

  /// One in the asymptotic range that the scatter does not exclude (likelihood ratio).
  bool an_order_is_possible() const {
    const double free = static_cast<double>(h_.size()) - 3, t = students_limit(free, sure);
    const auto& weights = likeliest_->weighted_ ? fine_ : equal_;
    double least = std::numeric_limits<double>::infinity();
    for (const double p : {least_order, std::clamp(likeliest_->exponent_, least_order, highest_order), highest_order})
      least = std::min(least, fit_of_order(weights, p).deviation_);
    return least * least <= likeliest_->deviation_ * likeliest_->deviation_ * (1 + t * t / free);
  }

  /// The best order between the ends of the search, the end itself if it is there.
  double best_order(const Eigen::VectorXd& weights) const {
    const double ratio = std::pow(search_to / search_from, 1. / search_points);
    const auto at = [&](double k) { return search_from * std::pow(ratio, k); };
    const auto deviation = [&](double p) { return fit_of_order(weights, p).deviation_; };
    int best = 0;
    for (int k = 1; k <= search_points; ++k)
      if (deviation(at(k)) < deviation(at(best))) best = k;
    if (best == 0 || best == search_points) return at(best);
    double low = at(best - 1), high = at(best + 1);
    while (high - low > 1e-9 * high) {  // far below what an order is read to
      const double third = (high - low) / 3;
      if (deviation(low + third) < deviation(high - third))
        high -= third;
      else
        low += third;
    }
    return 0.5 * (low + high);
  }

  /// Fits whose order lies in the asymptotic range; why there is none.
  std::vector<Convergence> with_order(std::string& refusal) {
    std::vector<Convergence> fits;
    if (phi_.maxCoeff() == phi_.minCoeff()) {
      refusal = "all meshes give the same value";
      return fits;
    }
    for (const auto* weights : {&equal_, &fine_}) {
      const double p = best_order(*weights);
      auto found = fit_of_order(*weights, p);
      found.weighted_ = weights == &fine_;
      if (!likeliest_ || found.deviation_ < likeliest_->deviation_) likeliest_ = found;
      if (p >= least_order && p < order_too_high) {
        found.order_ = p;
        fits.push_back(std::move(found));
      } else {
        any_too_low_ |= p < least_order;
        refusal =
            p < least_order
                ? fmt::format("they seem to converge with an order below {:g}, or not at all", least_order)
                : fmt::format(
                      "they change faster than with order {:g}, so that the coarsest mesh is too coarse to tell one",
                      order_too_high);
      }
    }
    return fits;
  }

  std::vector<Convergence> without_order(bool with_both_terms) const {
    std::vector<Convergence> fits;
    for (const auto* weights : {&equal_, &fine_}) {
      fits.push_back(fit(Form::first_order, *weights, {1}));
      fits.push_back(fit(Form::second_order, *weights, {2}));
      if (with_both_terms) fits.push_back(fit(Form::first_and_second_order, *weights, {1, 2}));
    }
    return fits;
  }

  std::span<const MeshValue> values_;
  Eigen::VectorXd h_, phi_, equal_, fine_;
  int rungs_;
  bool any_too_low_ = false;
  std::optional<Convergence> likeliest_;  // of any order
};

std::optional<Convergence> Convergence::of(std::span<const MeshValue> values) {
  if (std::ranges::any_of(values, [](const auto& v) { return !std::isfinite(v.value) || !(v.h > 0); })) return {};
  if (sizes_of(values) < 3) return {};
  auto counting = that_count(values);
  const bool lawful = leave_out_lawless(counting);
  auto found = Fitter(counting).best();
  found.coarsest_ = std::ranges::max_element(counting, {}, &MeshValue::h)->h;
  found.follows_no_law_ = !lawful;
  return found;
}

double Convergence::fitted(double h) const { return limit_ + first_ * std::pow(h, exponent_) + second_ * h * h; }

double Convergence::error(double h) const {
  const auto at = [&](double x) { return std::abs(fitted(x) - limit_); };
  // Terms of opposite sign cancel at one size: the largest error up to h counts, which the fit has at h or at its vertex.
  const double vertex = second_ != 0 ? -first_ / (2 * second_) : 0;
  return vertex > 0 && vertex < h ? std::max(at(h), at(vertex)) : at(h);
}

double Convergence::usual_band(double h, double beside) const {
  return scattered() ? poor_safety * (error(h) + beside) : safety_ * error(h) + beside;
}

double Convergence::of_the_model(double h) const {
  if (extrapolation_ && extrapolation_->is_of_repeated()) return (good_safety - 1) * extrapolation_->error(h);
  return order_ ? (good_safety - 1) * error(h) : 0;
}

double Convergence::band(const MeshValue& measured) const {
  const auto& [h, value] = measured;
  if (range_ == 0) return 0;
  if (extrapolation_) return extrapolation_->within(value, sure) + of_the_model(h);
  return usual_band(h, deviation_ + std::abs(value - fitted(h)));
}

double Convergence::band(double h) const {
  if (range_ == 0) return 0;
  return extrapolation_ ? extrapolation_->within_of_one_at(h, sure) + of_the_model(h) : usual_band(h, deviation_);
}

std::optional<double> Convergence::band_of_mean(std::span<const RunsOfSize> runs, std::size_t mean) const {
  if (!extrapolation_ || follows_no_law_ || runs[mean].h > same_to * coarsest_) return {};
  std::vector<RunsOfSize> counting;
  std::size_t at = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i == mean) at = counting.size();
    if (runs[i].h <= same_to * coarsest_) counting.push_back(runs[i]);
  }
  return extrapolation_->within_of_mean(counting, at) + of_the_model(runs[mean].h);
}

std::optional<double> Convergence::noise(double h) const {
  return extrapolation_ ? std::optional(extrapolation_->noise(h)) : std::nullopt;
}

}  // namespace splashdown::apps
