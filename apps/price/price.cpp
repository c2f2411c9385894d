#include "apps/price/price.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <sstream>

#include "apps/price/cost.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::apps {
namespace {

std::optional<double> deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return {};
  double mean = 0, squares = 0;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (n - 1));
}

/// Of the replicates and the rung that they stand beside.
std::optional<double> scatter_of(const PricedQuantity& quantity) {
  if (quantity.replicates.empty()) return {};
  std::vector<double> values;
  const double at = quantity.replicates.front().first.spec.refine;
  for (const auto* list : {&quantity.rungs, &quantity.replicates})
    for (const auto& [rung, value] : *list)
      if (std::abs(rung.spec.refine / at - 1) < 3 * replicate_offset) values.push_back(value);
  return deviation_of(values);
}

/// Against the mean of what was measured in the tank as it is, on meshes of that size.
std::optional<double> tank_influence(const PricedQuantity& quantity, int dimension) {
  if (quantity.in_larger_tank.empty()) return {};
  const auto& [larger, value] = quantity.in_larger_tank.front();
  double sum = 0, count = 0;
  for (const auto* list : {&quantity.rungs, &quantity.replicates})
    for (const auto& [rung, measured] : *list)
      if (std::abs(rung.spec.refine / larger.spec.refine - 1) < 2 * replicate_offset) sum += measured, ++count;
  if (count == 0) return {};
  return std::abs(value - sum / count) / (1 - std::pow(tank_growth, -dimension));
}

std::optional<Convergence> fit_of(const PricedQuantity& quantity) {
  std::vector<MeshValue> values;
  for (const auto* list : {&quantity.rungs, &quantity.replicates})
    for (const auto& [rung, value] : *list) values.push_back({1 / rung.spec.refine, value});
  return Convergence::of(values);
}

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

/// Of one quantity or of all together, at a refinement.
using AccuracyAt = std::function<std::optional<Decided>(double)>;

/// The coarsest mesh with that accuracy, up to `farthest_extrapolation` times finer than any made.
std::optional<double> refine_for(const Price& price, const AccuracyAt& accuracy, double wanted) {
  const auto holds = [&](double refine) {
    const auto worst = accuracy(refine);
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

std::vector<PriceRow> rows_of(const Price& price, const AccuracyAt& accuracy) {
  std::vector<PriceRow> rows;
  if (price.rungs.empty() || !accuracy(price.finest())) return rows;
  for (const double percent : price.percent) {
    PriceRow row{.accuracy_percent = percent,
                 .seconds = {},
                 .refine = refine_for(price, accuracy, percent / 100),
                 .decided_by = {}};
    if (row.refine) row.seconds = price.seconds(*row.refine);
    row.extrapolated = !row.refine || *row.refine > price.finest();
    row.measured = row.refine && is_made(price, *row.refine);
    row.decided_by = accuracy(row.refine.value_or(farthest_extrapolation * price.finest()))->second;
    // What the coarsest mesh does better than asked says nothing about coarser ones.
    const bool same = !rows.empty() && row.refine && rows.back().refine == row.refine;
    if (same) rows.pop_back();
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

double PricedQuantity::at(const RungSpec& spec) const {
  for (const auto* list : {&rungs, &replicates, &in_larger_tank})
    for (const auto& [rung, measured] : *list)
      if (rung.spec.refine == spec.refine && rung.spec.role == spec.role) return measured;
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::pair<Rung, double>>& PricedQuantity::list(Role role) {
  return role == Role::rung ? rungs : role == Role::replicate ? replicates : in_larger_tank;
}

double PricedQuantity::with_scatter_and_tank(double U) const {
  return std::hypot(U, 2 * scatter.value_or(0)) + tank.value_or(0);
}

std::optional<double> PricedQuantity::band(double refine) const {
  if (!fit) return {};
  return with_scatter_and_tank(fit->band(1 / refine));
}

std::optional<double> PricedQuantity::band_of(const RungSpec& spec) const {
  const double measured = at(spec);
  if (!fit || !std::isfinite(measured)) return band(spec.refine);
  return with_scatter_and_tank(fit->band({1 / spec.refine, measured}));
}

std::optional<double> PricedQuantity::band_of_finest() const { return band_of(rungs.back().first.spec); }

std::optional<double> PricedQuantity::relative(std::optional<double> width) const {
  if (!width || value == 0) return {};
  return *width / std::abs(value);
}

std::optional<double> PricedQuantity::accuracy(double refine) const { return relative(band(refine)); }

double Price::finest() const {
  double finest = 0;
  for (const auto& rung : rungs)
    if (rung.spec.role == Role::rung) finest = std::max(finest, rung.spec.refine);
  return finest;
}

double Price::coarsest() const {
  double coarsest = finest();
  for (const auto& rung : rungs) coarsest = std::min(coarsest, rung.spec.refine);
  return coarsest;
}

std::optional<double> Price::seconds(double refine) const {
  const RunCost cost(rungs, expected_nodes, dimension);
  return cost.known() ? std::optional(cost.seconds(refine)) : std::nullopt;
}

template <class Band>
std::optional<Decided> Price::widest(const Band& band) const {
  std::optional<Decided> worst;
  for (const auto& quantity : quantities) {
    const auto relative = quantity.relative(band(quantity));
    if (quantity.what.counts && relative && (!worst || *relative > worst->first))
      worst = {*relative, quantity.what.name};
  }
  return worst;
}

std::optional<Decided> Price::accuracy(double refine) const {
  return widest([refine](const PricedQuantity& quantity) { return quantity.band(refine); });
}

std::optional<Decided> Price::reached(const RungSpec& spec) const {
  return widest([&](const PricedQuantity& quantity) { return quantity.band_of(spec); });
}

std::vector<std::string> Price::without_band(const RungSpec& spec) const {
  std::vector<std::string> names;
  for (const auto& quantity : quantities)
    if (quantity.what.counts && !(quantity.fit && std::isfinite(quantity.at(spec))))
      names.push_back(quantity.what.name);
  return names;
}

std::optional<double> Price::refine_for(double wanted) const {
  return apps::refine_for(
      *this, [this](double refine) { return accuracy(refine); }, wanted);
}

bool Price::is_reached(double wanted) const {
  const auto refine = refine_for(wanted);
  return refine && *refine <= finest();
}

std::optional<double> Price::refine_in(double wanted) const {
  if (rungs.empty()) return {};
  const double far = farthest_run * finest();
  if (*seconds(far) <= wanted) return far;
  return least(coarsest(), far, [&](double refine) { return *seconds(refine) >= wanted; });
}

Price price_of(const std::vector<Rung>& rungs, const std::vector<PriceQuantity>& quantities, int dimension,
               std::vector<std::string>& notes) {
  Price price;
  price.dimension = dimension;
  price.rungs = rungs;
  std::ranges::sort(price.rungs, {}, [](const Rung& rung) { return rung.spec.refine; });
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    PricedQuantity priced{.what = quantities[q],
                          .scatter = {},
                          .tank = {},
                          .fit = {},
                          .rungs = {},
                          .replicates = {},
                          .in_larger_tank = {},
                          .rows = {}};
    for (const auto& rung : price.rungs)
      if (std::isfinite(rung.values[q])) priced.list(rung.spec.role).emplace_back(rung, rung.values[q]);
    if (priced.rungs.empty()) {
      notes.push_back(priced.what.name + " is left out: it has no value on any rung");
      continue;
    }
    priced.value = priced.rungs.back().second;
    priced.scatter = scatter_of(priced);
    priced.tank = tank_influence(priced, dimension);
    priced.fit = fit_of(priced);
    price.quantities.push_back(std::move(priced));
  }
  return price;
}

std::vector<double> listed_percent(std::optional<double> asked) {
  std::vector<double> all = {20, 10, 5, 2, 1, 0.5};
  if (asked && std::ranges::find(all, *asked) == all.end()) all.push_back(*asked);
  std::ranges::sort(all, std::greater());
  return all;
}

void list_rows(Price& price) {
  price.rows = rows_of(price, [&](double refine) { return price.accuracy(refine); });
  for (auto& quantity : price.quantities) {
    if (!quantity.what.counts) continue;
    quantity.rows = rows_of(price, [&](double refine) {
      const auto accuracy = quantity.accuracy(refine);
      return accuracy ? std::optional(Decided{*accuracy, quantity.what.name}) : std::nullopt;
    });
  }
}

const char* source_of(const PriceRow& row) {
  return row.extrapolated ? "extrapolated" : row.measured ? "measured" : "interpolated";
}

const PriceRow* row_for(const std::vector<PriceRow>& rows, double percent) {
  const auto row = std::ranges::find_if(
      rows, [&](const PriceRow& other) { return other.accuracy_percent <= percent && other.seconds; });
  return row == rows.end() ? nullptr : &*row;
}

std::string digest_of_scene(const std::filesystem::path& scene, std::vector<std::string> set) {
  set.emplace_back("fluid.size.refine=1");
  auto table = toml::parse(read_scene(scene, set).resolved);
  table.erase("title");
  table.erase("output");
  table.erase("limit");
  if (auto* records = table["record"].as_array())
    for (auto& record : *records) record.as_table()->erase("limit");
  std::ostringstream text;
  text << table;
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a (Fowler, Noll, Vo)
  for (const unsigned char byte : text.str()) hash = (hash ^ byte) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

}  // namespace splashdown::apps
