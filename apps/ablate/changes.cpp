#include "apps/ablate/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/price/bayesian_extrapolation.hpp"
#include "apps/quantity/expression.hpp"
#include "apps/quantity/names.hpp"

namespace splashdown::apps {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double confidence = 0.95;

/// By replicate.
using Values = std::vector<double>;

struct MeanAndBand {
  double mean = nan;
  std::optional<double> band;
};

MeanAndBand mean_of(const Values& values, bool scatters) {
  Values finite;
  std::ranges::copy_if(values, std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  if (finite.empty()) return {};
  const auto n = static_cast<double>(finite.size());
  double sum = 0, squares = 0;
  for (const double value : finite) sum += value;
  for (const double value : finite) squares += std::pow(value - sum / n, 2);
  MeanAndBand of{sum / n, {}};
  if (!scatters) of.band = 0;
  if (n > 1) of.band = students_limit(n - 1, confidence) * std::sqrt(squares / (n - 1) / n);
  return of;
}

std::optional<double> median(Values values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Below it a value is as good as zero.
double floor_of(const std::string& unit, const AblationPlan& plan) {
  const double share = 1e-3;
  if (unit == "g") return 0.01;
  if (unit == "m") return share * plan.length;
  if (unit == "m/s") return share * plan.speed;
  if (unit == "N" || unit == "N/m") return share * plan.load;
  if (unit.starts_with("N s") && plan.speed > 0) return share * plan.load * plan.length / plan.speed;
  return 0;
}

class Measurer {
 public:
  Measurer(const AblationPlan& plan, const std::vector<Outcome>& outcomes, const std::filesystem::path& folder,
           double least)
      : plan_(plan), outcomes_(outcomes), folder_(folder), least_(least) {}

  Ablation all() && {
    ablation_.quantities = plan_.quantities;
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) read(v);
    count_raw_peaks();
    for (std::size_t q = 0; q < ablation_.quantities.size(); ++q)
      ablation_.base.push_back(mean_of(values_[0][q], plan_.has_band()).mean);
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) conclude(v);
    return std::move(ablation_);
  }

 private:
  void read(std::size_t v) {
    std::vector<Values> values(plan_.quantities.size(), Values(plan_.replicates(), nan));
    VariantResult result;
    Values seconds;
    for (std::size_t r = 0; r < plan_.replicates(); ++r) {
      const std::size_t run = plan_.run_of(v, r);
      const auto& outcome = outcomes_[run];
      if (outcome.status != Outcome::Status::converged) {
        if (result.cause.empty())
          result.cause =
              outcome.cause.empty() ? word(outcome.status) : fmt::format("{}: {}", word(outcome.status), outcome.cause);
        continue;
      }
      std::string why;
      for (std::size_t q = 0; q < plan_.quantities.size(); ++q)
        values[q][r] = value_in(folder_ / plan_.runs[run].name, plan_.quantities[q], why);
      const auto summary = quantity::read_summary(folder_ / plan_.runs[run].name);
      if (const auto spent = quantity::find_entry(summary, "processor_seconds"))
        seconds.push_back(spent->numbers.front());
    }
    result.seconds = median(seconds);
    if (result.seconds) result.cause.clear();
    values_.push_back(std::move(values));
    ablation_.variants.push_back(std::move(result));
  }

  /// Where a run is too short for the filter.
  void count_raw_peaks() {
    const std::string filtered = "_cfc60";
    auto& quantities = ablation_.quantities;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const auto& name = quantities[q].name;
      if (!quantities[q].counts || !name.ends_with(filtered)) continue;
      if (std::isfinite(mean_of(values_[0][q], true).mean)) continue;
      const auto raw =
          std::ranges::find(quantities, name.substr(0, name.size() - filtered.size()) + "_raw", &PriceQuantity::name);
      if (raw != quantities.end()) raw->counts = true;
    }
  }

  Change change_of(std::size_t v, std::size_t q) const {
    const auto& quantity = ablation_.quantities[q];
    const auto scene = mean_of(values_[0][q], plan_.has_band());
    const double scale = std::max(std::abs(scene.mean), floor_of(quantity.unit, plan_));
    Change change{.value = mean_of(values_[v][q], true).mean, .relative = nan, .band = {}};
    if (!std::isfinite(scene.mean) || scale == 0) return change;
    const double sign = plan_.variants[v].kind == VariantKind::without ? -1 : 1;
    Values differences;
    for (std::size_t r = 0; r < plan_.replicates(); ++r)
      differences.push_back(sign * (values_[v][q][r] - values_[0][q][r]) / scale);
    const auto difference = mean_of(differences, plan_.has_band());
    change.relative = difference.mean;
    change.band = difference.band;
    if (!std::isfinite(change.relative) || scene.band.value_or(0) > 0.5 * scale) return change;
    change.meaning = !change.band                                         ? Meaning::unclear
                     : std::abs(change.relative) - *change.band > least_  ? Meaning::matters
                     : std::abs(change.relative) + *change.band <= least_ ? Meaning::small
                                                                          : Meaning::unclear;
    return change;
  }

  /// The quantity that says most for its effect; if none does, the one that leaves most room for it.
  static double weight(const Change& change) {
    const double band = change.band.value_or(0), size = std::abs(change.relative);
    return change.meaning == Meaning::matters ? size - band : size + band;
  }

  void conclude(std::size_t v) {
    auto& result = ablation_.variants[v];
    for (std::size_t q = 0; q < ablation_.quantities.size(); ++q) result.changes.push_back(change_of(v, q));
    const auto& variant = plan_.variants[v];
    if (variant.kind == VariantKind::scene || !result.cause.empty()) return;
    if (const auto own = ablation_.variants.front().seconds; own && result.seconds && *own > 0 && *result.seconds > 0)
      result.time_change =
          variant.kind == VariantKind::without ? *own / *result.seconds - 1 : *result.seconds / *own - 1;
    Meaning most = Meaning::none;
    for (std::size_t q = 0; q < result.changes.size(); ++q) {
      const auto& change = result.changes[q];
      if (!ablation_.quantities[q].counts || change.meaning == Meaning::none) continue;
      const bool decides =
          change.meaning > most ||
          (change.meaning == most && (!result.deciding || weight(change) > weight(result.changes[*result.deciding])));
      if (decides) result.deciding = q;
      most = std::max(most, change.meaning);
    }
    result.verdict = verdict(variant.kind, most);
    if (most != Meaning::matters && most != Meaning::small) return;
    if (variant.advised && *variant.advised != Advised::doubtful)
      result.agrees = (*variant.advised == Advised::on) == (most == Meaning::matters);
  }

  static std::string verdict(VariantKind kind, Meaning most) {
    if (most == Meaning::none || most == Meaning::unclear) return "undecided";
    const bool counts = most == Meaning::matters;
    if (kind == VariantKind::choice) return counts ? "matters" : "does not matter";
    if (kind == VariantKind::with) return counts ? "add" : "leave out";
    return counts ? "keep" : "leave out";
  }

  const AblationPlan& plan_;
  const std::vector<Outcome>& outcomes_;
  const std::filesystem::path& folder_;
  double least_;
  Ablation ablation_;
  std::vector<std::vector<Values>> values_;  ///< by variant, quantity
};

/// Two digits, and no more than one behind the point.
std::string percent_text(double share) {
  const double percent = 100 * share, size = std::abs(percent);
  return size >= 10     ? fmt::format("{:.0f}", percent)
         : size >= 0.95 ? fmt::format("{:.1f}", percent)
                        : fmt::format("{:.2f}", percent);
}

}  // namespace

const char* word(Meaning meaning) {
  constexpr const char* words[] = {"", "small", "unclear", "matters"};
  return words[static_cast<int>(meaning)];
}

Ablation ablation_of(const AblationPlan& plan, const std::vector<Outcome>& outcomes,
                     const std::filesystem::path& folder, double least) {
  return Measurer(plan, outcomes, folder, least).all();
}

std::string change_text(const Change& change) {
  if (!std::isfinite(change.relative)) return "-";
  auto text = fmt::format("{}{} %", change.relative > 0 ? "+" : "", percent_text(change.relative));
  if (change.band) text += fmt::format(" ± {} %", percent_text(*change.band));
  return text;
}

std::string verdict_line(const AblationPlan& plan, const Ablation& ablation, std::size_t v) {
  const auto& variant = plan.variants[v];
  const auto& result = ablation.variants[v];
  const std::string name =
      variant.kind == VariantKind::choice ? fmt::format("{} ({})", variant.what, variant.name) : variant.what;
  if (!result.cause.empty()) return fmt::format("{}: no result: {}", name, result.cause);
  std::string text = name + ": ";
  if (result.deciding)
    text +=
        fmt::format("{} {}", change_text(result.changes[*result.deciding]), ablation.quantities[*result.deciding].name);
  else
    text += "no number that could decide";
  if (result.time_change)
    text += fmt::format(", {}{:.0f} % time", *result.time_change >= 0 ? "+" : "", 100 * *result.time_change);
  text += ": " + result.verdict;
  if (variant.advised)
    text += fmt::format(" (advise: {}{})", word(*variant.advised),
                        result.agrees ? *result.agrees ? ", agrees" : ", disagrees" : "");
  return text;
}

}  // namespace splashdown::apps
