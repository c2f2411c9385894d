// What accuracy costs: bands of the quantities on each rung, and the refinement and the seconds that a band takes.
//
//   band = sqrt(U^2 + (2 s)^2) + T
//
// U: of the fit over the ladder (convergence.hpp); s: standard deviation between meshes of equal size, the quantity's
// replicates with the rung that they repeat. A single run is one of such meshes, whatever the fit says of their mean.
// Where a mesh tells its error by itself (PriceQuantity::told), the band is that over `least_effectivity`, without ladder and scatter.
// The mean of N runs on meshes of one size has U of itself and Student's t s / sqrt(N) with their own s (mean_plan.hpp).
// T, where the tank stands for open water: the change by a tank g = 1.5 times as large over 1 - g^-d. A body and its images in the
// walls are dipoles, whose flow falls with the distance to the power d (Newman 1977, section 4.9).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/price/convergence.hpp"
#include "apps/price/ladder.hpp"
#include "apps/price/means/mean_plan.hpp"

namespace splashdown::apps {

/// Of errors that meshes tell of themselves over the true ones, at least: what tests of goals hold.
inline constexpr double least_effectivity = 0.7;

/// As price lists have them, 1, 2, 5, and one that is asked for.
std::vector<double> listed_percent(std::optional<double> asked);

/// A relative accuracy and the quantity that decides it.
using Decided = std::pair<double, std::string>;

struct PriceRow {
  double accuracy_percent = 0;
  std::optional<double> seconds, refine;  ///< absent: refinement does not get there
  bool extrapolated = false;
  bool measured = false;   ///< it was made; else, unless it is extrapolated, between two meshes that were, or planned
  std::string decided_by;  ///< the quantity that asks for most
  int runs = 1;            ///< more: their mean; `seconds` are of all, and of those beside
  std::vector<std::pair<double, int>> beside = {};  ///< refine and number of further runs, which tell its bias
};

/// "measured", "interpolated", "extrapolated" or "planned": where the numbers of a row are from.
const char* source_of(const PriceRow& row);

/// The first row with this accuracy or a better one; nothing: refinement does not get there.
const PriceRow* row_for(const std::vector<PriceRow>& rows, double percent);

/// Of runs on meshes of one size.
struct MeanOfRuns {
  int runs = 0;
  double value = 0, deviation = 0, band = 0;  ///< deviation: between the runs
};

struct PricedQuantity {
  PriceQuantity what;
  double value = 0;                ///< of the finest rung
  std::optional<double> scatter;   ///< s; absent: no replicates
  std::optional<double> tank;      ///< T; absent: not asked for
  std::optional<Convergence> fit;  ///< absent: too few rungs, or `told`
  /// By refine, from the coarsest on: errors that its meshes tell of themselves, without their signs; empty: none do.
  std::vector<std::pair<double, double>> told = {};
  /// With the value, from the coarsest on.
  std::vector<std::pair<Rung, double>> rungs, replicates, in_larger_tank;
  std::vector<PriceRow> rows;  ///< what it costs by itself; empty: it does not count or has no fit

  std::vector<std::pair<Rung, double>>& list(Role role);
  double at(const RungSpec& spec) const;            ///< of the run there; nan: there is none
  std::optional<double> band(double refine) const;  ///< of a run there [unit]
  std::optional<double> band_of_finest() const;
  /// Of the value measured there; of one to be measured, if there is none.
  std::optional<double> band_of(const RungSpec& spec) const;
  /// All that were measured on meshes of the size of this one.
  std::vector<double> of_size(double refine) const;
  /// Nothing: fewer than `fewest_of_mean`, or no fit.
  std::optional<MeanOfRuns> mean(double refine) const;
  /// The band that a mean is expected to have; infinite: not known.
  double expected_band(std::span<const RunsOfSize> runs, std::size_t mean) const;
  std::optional<double> relative(std::optional<double> band) const;  ///< to the value of the finest rung
  /// Relative, of a run that is still to be made there; nothing: not known.
  std::optional<double> accuracy(double refine) const;

 private:
  std::optional<double> told_band(double refine) const;
  double with(double U, double scatter_band) const;
  double with_scatter_and_tank(double U) const;
};

struct Price {
  std::string scene, title, scene_digest;
  int dimension = 2;
  std::vector<PricedQuantity> quantities;
  std::vector<Rung> rungs;                           ///< all that were made, replicates too
  std::vector<double> percent = listed_percent({});  ///< what rows are for, from the loosest on
  double asked = 0;                                  ///< relative accuracy that a mesh was to have; 0: not known
  std::vector<PriceRow> rows;
  std::vector<std::pair<double, double>> expected_nodes;  ///< by refine, of the scene's sizes; empty: not known

  std::optional<double> seconds(double refine) const;
  double finest() const;
  double coarsest() const;
  /// The least relative accuracy that all quantities that count have there; nothing: not known of any.
  std::optional<Decided> accuracy(double refine) const;
  /// The same of what was measured there.
  std::optional<Decided> reached(const RungSpec& spec) const;
  /// The same of the mean of the runs on meshes of that size; nothing: one that counts and has a band has none there.
  std::optional<Decided> reached_by_mean(double refine) const;
  /// Sizes of mesh of the ladder, from the coarsest on, with the mean of the seconds and the number of the runs of each.
  std::vector<SizeOfMesh> sizes() const;
  /// Relative, of all that count.
  BandOfMean expected_of_mean() const;
  /// How to have that accuracy for the fewest seconds: one run or the mean of several; nothing: neither gets there.
  std::optional<PriceRow> cheapest_for(double accuracy) const;
  /// Quantities that count and of which nothing is known there: no value, or on too few meshes for a band.
  std::vector<std::string> without_band(const RungSpec& spec) const;
  /// The coarsest mesh with that accuracy, up to `farthest` times finer than any made.
  std::optional<double> refine_for(double accuracy) const;
  /// Whether one of the meshes that were made, or one between them, or a mean of runs has that accuracy.
  bool is_reached(double accuracy) const;
  bool is_reached_by_mean(double accuracy) const;
  /// The finest mesh whose run takes no longer, not below the coarsest made, nor more than `farthest_run` times finer than any.
  std::optional<double> refine_in(double seconds) const;

 private:
  template <class Band>
  std::optional<Decided> widest(const Band& band) const;
};

/// Beyond it the fit says nothing that could be held against a run.
inline constexpr double farthest_extrapolation = 4;
/// Beyond it what a run takes may be ruled by what no coarse one had: on fine meshes jets tear, and steps are a third as long.
inline constexpr double farthest_run = 2;

/// Of the sizes with a mean, by refine, the one with the narrowest band.
std::optional<std::pair<double, MeanOfRuns>> best_mean(const PricedQuantity& quantity);

/// All runs of a price with the values of its quantities, in their order.
std::vector<Rung> measured_runs(const Price& price);
std::vector<PriceQuantity> quantities_of(const Price& price);

/// Quantities without a value on three rungs are left out, and named in `notes`.
Price price_of(const std::vector<Rung>& rungs, const std::vector<PriceQuantity>& quantities, int dimension,
               std::vector<std::string>& notes);
/// Fills the rows of the price and of its quantities, when it knows what nodes its scene expects: each is a search over bands.
void list_rows(Price& price);

/// Of a scene at refine = 1, whatever its title and output: FNV-1a, 16 hexadecimal digits.
std::string digest_of_scene(const std::filesystem::path& scene, std::vector<std::string> set);

}  // namespace splashdown::apps
