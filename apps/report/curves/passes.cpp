#include "apps/report/curves/passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/report/curves/style.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

/// An attempt at a step.
struct Attempt {
  double step = 0, time = 0;
  bool accepted = false;
  Values residuals;  ///< after pass 1, 2, ...
};

std::vector<Attempt> attempts_in(const Table& passes) {
  std::vector<Attempt> attempts;
  const auto &step = passes["step"], &time = passes["time"], &accepted = passes["accepted"], &pass = passes["pass"],
             &residual = passes["residual"];
  if (accepted.empty() || residual.empty() || pass.empty() || step.empty() || time.empty()) return {};
  for (std::size_t i = 0; i < passes.rows(); ++i) {
    if (pass[i] == 1 || attempts.empty()) attempts.push_back({step[i], time[i], accepted[i] == 1, {}});
    attempts.back().residuals.push_back(residual[i]);
  }
  return attempts;
}

Curve curve_of(const std::string& what, const Attempt& attempt, const Unit& time, const char* colour) {
  Curve curve{fmt::format("{}: step {}, {} {}", what, count_text(attempt.step), digits(attempt.time * time.scale, 3),
                          time.unit),
              {},
              attempt.residuals,
              colour,
              1.8};
  for (std::size_t pass = 1; pass <= attempt.residuals.size(); ++pass) curve.x.push_back(static_cast<double>(pass));
  return curve;
}

/// What lies between the lowest and the highest residual after each pass, of the attempts that took it.
Between all_of(const std::vector<const Attempt*>& attempts) {
  Between band{"all steps", {}, {}, {}};
  for (std::size_t pass = 0;; ++pass) {
    double low = INFINITY, high = 0;
    for (const auto* attempt : attempts)
      if (pass < attempt->residuals.size() && attempt->residuals[pass] > 0) {
        low = std::min(low, attempt->residuals[pass]);
        high = std::max(high, attempt->residuals[pass]);
      }
    if (high == 0) return band;
    band.x.push_back(static_cast<double>(pass + 1));
    band.low.push_back(low);
    band.high.push_back(high);
  }
}

/// Mean factor of the residual from one pass to the next; nan with one pass, or from zero.
double factor_of(const Attempt& attempt) {
  const auto& r = attempt.residuals;
  if (r.size() < 2 || !(r.front() > 0) || !(r.back() > 0)) return NAN;
  return std::pow(r.back() / r.front(), 1 / static_cast<double>(r.size() - 1));
}

bool shorter(const Attempt* a, const Attempt* b) { return a->residuals.size() < b->residuals.size(); }

Figure convergence_figure(std::vector<const Attempt*> accepted, const Attempt* refused, const Unit& time) {
  Figure figure;
  figure.name = "residuals";
  figure.x_label = "pass";
  figure.y_label = "residual";
  figure.log_y = true;
  std::ranges::stable_sort(accepted, shorter);
  if (!accepted.empty()) {
    figure.between = {all_of(accepted)};
    figure.curves = {curve_of("median", *accepted[accepted.size() / 2], time, ink),
                     curve_of("most passes", *accepted.back(), time, amber)};
  }
  if (refused) figure.curves.push_back(curve_of("refused", *refused, time, red));
  figure.caption = fmt::format(
      "Residual of the velocities between water and bodies after each pass, relative to those of the step. Shaded: {} "
      "recorded step{}; the median is that of the number of passes{}.",
      count_text(static_cast<double>(accepted.size())), accepted.size() == 1 ? "" : "s",
      refused ? ". Red: the attempt with most passes of those that were refused" : "");
  return figure;
}

Figure factor_figure(const std::vector<const Attempt*>& accepted, const Unit& time) {
  Figure figure;
  figure.name = "residual_factor";
  figure.x_label = "t / " + time.unit;
  figure.y_label = "factor a pass";
  figure.over_time = true;
  figure.log_y = true;
  Curve curve{"", {}, {}, blue, 1.2};
  curve.points = true;
  for (const auto* attempt : accepted)
    if (const double factor = factor_of(*attempt); std::isfinite(factor)) {
      curve.x.push_back(attempt->time * time.scale);
      curve.y.push_back(factor);
    }
  if (!curve.x.empty()) figure.curves = {std::move(curve)};
  figure.caption =
      "By what a pass multiplies the residual, mean over the passes of a step: 0.1 gains a digit a pass, 1 gains "
      "nothing.";
  return figure;
}

}  // namespace

std::vector<Figure> pass_figures(const Table& passes, double end_time) {
  const auto attempts = attempts_in(passes);
  std::vector<const Attempt*> accepted, refused;
  for (const auto& attempt : attempts) (attempt.accepted ? accepted : refused).push_back(&attempt);
  if (std::ranges::none_of(attempts, [](const Attempt& attempt) { return attempt.residuals.size() > 1; })) return {};
  const Unit time = time_unit(end_time);
  std::vector<Figure> figures{
      convergence_figure(accepted, refused.empty() ? nullptr : *std::ranges::max_element(refused, shorter), time)};
  if (auto factors = factor_figure(accepted, time); !factors.curves.empty()) figures.push_back(std::move(factors));
  return figures;
}

}  // namespace splashdown::apps
