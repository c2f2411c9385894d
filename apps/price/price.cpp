#include "apps/price/price.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// Of the finest size with two replicates or more, else of any.
std::optional<double> scatter_of(const PricedQuantity& quantity) {
  std::optional<double> scatter;
  bool enough = false;
  for (const auto& [rung, measured] : quantity.rungs) {  // from the coarsest on
    const auto values = quantity.of_size(rung.spec.refine);
    if (values.size() < (enough ? 3u : 2u)) continue;
    enough |= values.size() >= 3;
    scatter = deviation_of(values);
  }
  return scatter;
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

double PricedQuantity::with(double U, double scatter_band) const {
  return std::hypot(U, scatter_band) + tank.value_or(0);
}

double PricedQuantity::with_scatter_and_tank(double U) const { return with(U, 2 * scatter.value_or(0)); }

std::vector<double> PricedQuantity::of_size(double refine) const {
  std::vector<double> values;
  for (const auto* list : {&rungs, &replicates})
    for (const auto& [rung, measured] : *list)
      if (std::abs(rung.spec.refine / refine - 1) < same_size) values.push_back(measured);
  return values;
}

std::optional<MeanOfRuns> PricedQuantity::mean(double refine) const {
  const auto values = of_size(refine);
  if (!fit || static_cast<int>(values.size()) < fewest_of_mean) return {};
  MeanOfRuns found{.runs = static_cast<int>(values.size()), .deviation = *deviation_of(values)};
  for (const double each : values) found.value += each / found.runs;
  found.band = with(fit->band({1 / refine, found.value}), band_of_scatter(found.deviation, found.runs));
  return found;
}

double PricedQuantity::expected_band(std::span<const RunsOfSize> runs, std::size_t mean) const {
  const auto U = fit ? fit->band_of_mean(runs, mean) : std::nullopt;
  if (!U) return HUGE_VAL;
  return with(*U, band_of_scatter(*fit->noise(runs[mean].h), runs[mean].runs));
}

std::optional<double> PricedQuantity::told_band(double refine) const {
  if (told.empty()) return {};
  // Errors of single meshes pass through zero: none counts for less than those of finer ones.
  std::vector<std::pair<double, double>> points = told;
  for (std::size_t k = points.size() - 1; k-- > 0;) points[k].second = std::max(points[k].second, points[k + 1].second);
  const auto after =
      std::ranges::find_if(points, [&](const auto& point) { return point.first >= refine * (1 - 1e-9); });
  if (after != points.end() && std::abs(after->first / refine - 1) < 1e-9) return after->second / least_effectivity;
  // Between two meshes a power law; beyond them that of the outermost two, of first to fourth order.
  if (points.size() < 2)
    return points[0].second * std::pow(points[0].first / refine, refine > points[0].first ? 1 : 4) / least_effectivity;
  const auto right = std::clamp<std::ptrdiff_t>(after - points.begin(), 1, std::ssize(points) - 1);
  const auto& [a, from] = points[static_cast<std::size_t>(right - 1)];
  const auto& [b, to] = points[static_cast<std::size_t>(right)];
  if (!(from > 0 && to > 0)) return std::max(from, to) / least_effectivity;
  double order = std::log(from / to) / std::log(b / a);
  if (after == points.end()) order = std::clamp(order, 1., 4.);
  return to * std::pow(b / refine, order) / least_effectivity;
}

std::optional<double> PricedQuantity::band(double refine) const {
  if (const auto band = told_band(refine)) return band;
  if (!fit) return {};
  return with_scatter_and_tank(fit->band(1 / refine));
}

std::optional<double> PricedQuantity::band_of(const RungSpec& spec) const {
  const double measured = at(spec);
  if (!told.empty()) return told_band(spec.refine);
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

std::optional<Decided> Price::reached_by_mean(double refine) const {
  for (const auto& quantity : quantities)
    if (quantity.what.counts && quantity.fit && !quantity.mean(refine)) return {};
  return widest([&](const PricedQuantity& quantity) -> std::optional<double> {
    const auto mean = quantity.mean(refine);
    return mean ? std::optional(mean->band) : std::nullopt;
  });
}

std::vector<SizeOfMesh> Price::sizes() const {
  std::vector<SizeOfMesh> sizes;
  for (const auto& own : rungs) {
    const double refine = own.spec.refine;
    if (own.spec.role != Role::rung || (!sizes.empty() && std::abs(refine * sizes.back().h - 1) < same_size)) continue;
    SizeOfMesh size{1 / refine, 0, 0};
    for (const auto& rung : rungs)
      if (rung.spec.role != Role::larger_tank && std::abs(rung.spec.refine / refine - 1) < same_size)
        size.seconds += rung.seconds, ++size.made;
    size.seconds /= size.made;
    sizes.push_back(size);
  }
  return sizes;
}

BandOfMean Price::expected_of_mean() const {
  return [this](std::span<const RunsOfSize> runs, std::size_t mean) {
    double widest = 0;
    for (const auto& quantity : quantities)
      if (quantity.what.counts && quantity.fit)
        widest = std::max(widest, quantity.relative(quantity.expected_band(runs, mean)).value_or(0));
    return widest > 0 ? widest : HUGE_VAL;
  };
}

std::vector<std::string> Price::without_band(const RungSpec& spec) const {
  std::vector<std::string> names;
  for (const auto& quantity : quantities)
    if (quantity.what.counts && !((quantity.fit || !quantity.told.empty()) && std::isfinite(quantity.at(spec))))
      names.push_back(quantity.what.name);
  return names;
}

std::vector<PriceQuantity> quantities_of(const Price& price) {
  std::vector<PriceQuantity> quantities;
  for (const auto& quantity : price.quantities) quantities.push_back(quantity.what);
  return quantities;
}

std::vector<Rung> measured_runs(const Price& price) {
  auto runs = price.rungs;
  for (auto& run : runs) {
    run.values.clear();
    run.told.clear();
    for (const auto& quantity : price.quantities) {
      run.values.push_back(quantity.at(run.spec));
      const auto told = std::ranges::find(quantity.told, run.spec.refine, &std::pair<double, double>::first);
      run.told.push_back(told == quantity.told.end() ? std::nan("") : told->second);
    }
  }
  return runs;
}

std::optional<std::pair<double, MeanOfRuns>> best_mean(const PricedQuantity& quantity) {
  std::optional<std::pair<double, MeanOfRuns>> best;
  for (const auto& [rung, value] : quantity.rungs)
    if (const auto mean = quantity.mean(rung.spec.refine); mean && (!best || mean->band < best->second.band))
      best = {rung.spec.refine, *mean};
  return best;
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
    for (const auto& [rung, value] : priced.rungs)
      if (q < rung.told.size() && std::isfinite(rung.told[q]))
        priced.told.emplace_back(rung.spec.refine, std::abs(rung.told[q]));
    if (priced.told.empty()) priced.fit = fit_of(priced);
    price.quantities.push_back(std::move(priced));
  }
  return price;
}

std::string digest_of_scene(const std::filesystem::path& scene, std::vector<std::string> set) {
  for (auto& word : refined_by(refine_keys_of(scene, set), 1)) set.push_back(std::move(word));
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
