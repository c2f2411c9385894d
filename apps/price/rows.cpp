// The rows of a price list: for each accuracy the mesh or the mean that has it for the fewest seconds.
#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/price/price.hpp"

namespace splashdown::apps {
namespace {

/// The least x between two ends for which `holds`, which does for all larger ones.
template <class Holds>
double least(double low, double high, const Holds& holds) {
  if (holds(low)) return low;
  for (int i = 0; i < 60 && high / low > 1 + 1e-6; ++i) {
    const double middle = std::sqrt(low * high);
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

/// What is known of one quantity or of all together.
struct Judge {
  std::function<std::optional<Decided>(double refine)> accuracy, by_mean;
  BandOfMean expected;                                                                   ///< relative
  std::function<std::string(std::span<const RunsOfSize>, std::size_t mean)> decided_by;  ///< of what is expected
};

/// The coarsest mesh with that accuracy, up to `farthest_extrapolation` times finer than any made.
std::optional<double> refine_for(const Price& price, const Judge& judge, double wanted) {
  const auto holds = [&](double refine) {
    const auto worst = judge.accuracy(refine);
    return worst && worst->first <= wanted;
  };
  const double far = farthest_extrapolation * price.finest();
  if (price.rungs.empty() || !holds(far)) return {};
  return least(price.coarsest(), far, holds);
}

/// With the three digits that rows are told with.
bool is_made(const Price& price, double refine) {
  return std::ranges::any_of(price.rungs, [&](const Rung& rung) {
    return rung.spec.role == Role::rung && std::abs(rung.spec.refine / refine - 1) < 1e-3;
  });
}

PriceRow row_of_one_run(const Price& price, const Judge& judge, double percent) {
  PriceRow row{
      .accuracy_percent = percent, .seconds = {}, .refine = refine_for(price, judge, percent / 100), .decided_by = {}};
  if (row.refine) row.seconds = price.seconds(*row.refine);
  row.extrapolated = !row.refine || *row.refine > price.finest();
  row.measured = row.refine && is_made(price, *row.refine);
  row.decided_by = judge.accuracy(row.refine.value_or(farthest_extrapolation * price.finest()))->second;
  return row;
}

double refine_of(const SizeOfMesh& size) { return 1 / size.h; }

/// Means that were made, with all runs beside the ladder.
std::vector<PriceRow> rows_of_made_means(const Price& price, const Judge& judge) {
  std::vector<PriceRow> rows;
  const auto sizes = price.sizes();
  for (const auto& size : sizes) {
    const auto reached = judge.by_mean(refine_of(size));
    if (!reached) continue;
    PriceRow row{.accuracy_percent = 100 * reached->first,
                 .seconds = size.made * size.seconds,
                 .refine = refine_of(size),
                 .measured = true,
                 .decided_by = reached->second,
                 .runs = size.made};
    for (const auto& other : sizes)
      if (&other != &size && other.made > 1) {
        *row.seconds += (other.made - 1) * other.seconds;
        row.beside.emplace_back(refine_of(other), other.made - 1);
      }
    rows.push_back(std::move(row));
  }
  return rows;
}

PriceRow row_of(const MeanPlan& plan, const Judge& judge) {
  PriceRow row{.accuracy_percent = 100 * plan.band,
               .seconds = plan.seconds,
               .refine = 1 / plan.runs[plan.mean].h,
               .decided_by = judge.decided_by(plan.runs, plan.mean),
               .runs = plan.runs[plan.mean].runs};
  for (std::size_t i = 0; i < plan.runs.size(); ++i)
    if (i != plan.mean && plan.runs[i].runs > 1) row.beside.emplace_back(1 / plan.runs[i].h, plan.runs[i].runs - 1);
  return row;
}

/// One run or the mean of several, whichever takes fewer seconds.
class CheapestRow {
 public:
  CheapestRow(const Price& price, const Judge& judge) : price_(price), judge_(judge), sizes_(price.sizes()) {
    made_ = rows_of_made_means(price, judge);
    for (auto& size : sizes_) size.made = 1;  // what a mean takes beside the ladder does not depend on what was made
  }

  PriceRow at(double percent) {
    auto row = row_of_one_run(price_, judge_, percent);
    // Nor can a mean be cheaper than this.
    if (row.seconds && *row.seconds <= fewest_of_mean * sizes_.front().seconds) return row;
    for (const auto& made : made_)
      if (made.accuracy_percent <= percent) take(row, made, percent, 1);
    // A plan is a promise: it has to be cheaper by a half than what was measured.
    const double doubt = row.measured && row.runs > 1 ? 1.5 : 1;
    if (const auto* plan = cheapest(plans(), percent / 100, &MeanPlan::seconds))
      take(row, row_of(*plan, judge_), percent, doubt);
    return row;
  }

 private:
  static void take(PriceRow& row, const PriceRow& other, double percent, double doubt) {
    if (row.seconds && *row.seconds <= doubt * *other.seconds) return;
    row = other;
    row.accuracy_percent = percent;
  }

  std::span<const MeanPlan> plans() {
    if (!plans_) plans_ = mean_plans(sizes_, judge_.expected, price_.percent.back() / 100);
    return *plans_;
  }

  const Price& price_;
  const Judge& judge_;
  std::vector<SizeOfMesh> sizes_;
  std::vector<PriceRow> made_;
  std::optional<std::vector<MeanPlan>> plans_;
};

bool same_runs(const PriceRow& a, const PriceRow& b) {
  return a.refine == b.refine && a.runs == b.runs && a.beside == b.beside;
}

std::vector<PriceRow> rows_of(const Price& price, const Judge& judge) {
  std::vector<PriceRow> rows;
  if (price.rungs.empty() || !judge.accuracy(price.finest())) return rows;
  CheapestRow cheapest_row(price, judge);
  for (const double percent : price.percent) {
    auto row = cheapest_row.at(percent);
    // What the coarsest mesh does better than asked says nothing about coarser ones.
    if (!rows.empty() && row.refine && same_runs(rows.back(), row)) rows.pop_back();
    rows.push_back(std::move(row));
  }
  return rows;
}

Judge judge_of(const PricedQuantity& quantity) {
  const auto named = [&quantity](std::optional<double> relative) {
    return relative ? std::optional(Decided{*relative, quantity.what.name}) : std::nullopt;
  };
  return {.accuracy = [&, named](double refine) { return named(quantity.accuracy(refine)); },
          .by_mean =
              [&, named](double refine) {
                const auto mean = quantity.mean(refine);
                return named(mean ? quantity.relative(mean->band) : std::nullopt);
              },
          .expected =
              [&](std::span<const RunsOfSize> runs, std::size_t mean) {
                return quantity.relative(quantity.expected_band(runs, mean)).value_or(HUGE_VAL);
              },
          .decided_by = [&](auto, auto) { return quantity.what.name; }};
}

/// Of all that count together.
Judge judge_of(const Price& price) {
  const auto decided_by = [&](std::span<const RunsOfSize> runs, std::size_t mean) {
    Decided worst{-1, ""};
    for (const auto& quantity : price.quantities)
      if (quantity.what.counts && quantity.fit)
        if (const auto band = quantity.relative(quantity.expected_band(runs, mean)); band && *band > worst.first)
          worst = {*band, quantity.what.name};
    return worst.second;
  };
  return {.accuracy = [&](double refine) { return price.accuracy(refine); },
          .by_mean = [&](double refine) { return price.reached_by_mean(refine); },
          .expected = price.expected_of_mean(),
          .decided_by = decided_by};
}

}  // namespace

std::optional<PriceRow> Price::cheapest_for(double wanted) const {
  if (rungs.empty() || !accuracy(finest())) return {};
  const auto judge = judge_of(*this);
  const auto row = CheapestRow(*this, judge).at(100 * wanted);
  return row.seconds ? std::optional(row) : std::nullopt;
}

std::optional<double> Price::refine_for(double wanted) const {
  return apps::refine_for(*this, judge_of(*this), wanted);
}

bool Price::is_reached(double wanted) const {
  const auto refine = refine_for(wanted);
  return (refine && *refine <= finest()) || is_reached_by_mean(wanted);
}

bool Price::is_reached_by_mean(double wanted) const {
  return std::ranges::any_of(sizes(), [&](const SizeOfMesh& size) {
    const auto reached = reached_by_mean(refine_of(size));
    return reached && reached->first <= wanted;
  });
}

std::optional<double> Price::refine_in(double wanted) const {
  if (rungs.empty()) return {};
  const double far = farthest_run * finest();
  if (*seconds(far) <= wanted) return far;
  return least(coarsest(), far, [&](double refine) { return *seconds(refine) >= wanted; });
}

std::vector<double> listed_percent(std::optional<double> asked) {
  std::vector<double> all = {20, 10, 5, 2, 1, 0.5};
  if (asked && std::ranges::find(all, *asked) == all.end()) all.push_back(*asked);
  std::ranges::sort(all, std::greater());
  return all;
}

void list_rows(Price& price) {
  price.rows = rows_of(price, judge_of(price));
  for (auto& quantity : price.quantities)
    if (quantity.what.counts) quantity.rows = rows_of(price, judge_of(quantity));
}

const char* source_of(const PriceRow& row) {
  if (row.extrapolated) return "extrapolated";
  return row.measured ? "measured" : row.runs > 1 ? "planned" : "interpolated";
}

const PriceRow* row_for(const std::vector<PriceRow>& rows, double percent) {
  const auto row = std::ranges::find_if(
      rows, [&](const PriceRow& other) { return other.accuracy_percent <= percent && other.seconds; });
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace splashdown::apps
