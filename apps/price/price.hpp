// What accuracy costs: bands of the quantities on each rung, and the refinement and the seconds that a band takes.
//
//   band = sqrt(U^2 + (2 s)^2) + T
//
// U: of the fit over the ladder (convergence.hpp); s: standard deviation between meshes of equal size, the quantity's
// replicates with the rung that they repeat. A single run is one of such meshes, whatever the fit says of their mean.
// T, where the tank stands for open water: the change by a tank g = 1.5 times as large over 1 - g^-d. A body and its images in the
// walls are dipoles, whose flow falls with the distance to the power d (Newman 1977, section 4.9).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/price/convergence.hpp"
#include "apps/price/ladder.hpp"

namespace splashdown::apps {

/// As price lists have them, 1, 2, 5, and one that is asked for.
std::vector<double> listed_percent(std::optional<double> asked);

/// A relative accuracy and the quantity that decides it.
using Decided = std::pair<double, std::string>;

struct PriceRow {
  double accuracy_percent = 0;
  std::optional<double> seconds, refine;  ///< absent: refinement does not get there
  bool extrapolated = false;
  bool measured = false;   ///< a run was made on this mesh; else, unless it is extrapolated, between two that were
  std::string decided_by;  ///< the quantity that asks for most
};

/// "measured", "interpolated" or "extrapolated": where the numbers of a row are from.
const char* source_of(const PriceRow& row);

/// The first row with this accuracy or a better one; nothing: refinement does not get there.
const PriceRow* row_for(const std::vector<PriceRow>& rows, double percent);

struct PricedQuantity {
  PriceQuantity what;
  double value = 0;                ///< of the finest rung
  std::optional<double> scatter;   ///< s; absent: no replicates
  std::optional<double> tank;      ///< T; absent: not asked for
  std::optional<Convergence> fit;  ///< absent: too few rungs
  /// With the value, from the coarsest on.
  std::vector<std::pair<Rung, double>> rungs, replicates, in_larger_tank;
  std::vector<PriceRow> rows;  ///< what it costs by itself; empty: it does not count or has no fit

  std::vector<std::pair<Rung, double>>& list(Role role);
  double at(const RungSpec& spec) const;            ///< of the run there; nan: there is none
  std::optional<double> band(double refine) const;  ///< of a run there [unit]
  std::optional<double> band_of_finest() const;
  /// Of the value measured there; of one to be measured, if there is none.
  std::optional<double> band_of(const RungSpec& spec) const;
  std::optional<double> relative(std::optional<double> band) const;  ///< to the value of the finest rung
  /// Relative, of a run that is still to be made there; nothing: not known.
  std::optional<double> accuracy(double refine) const;

 private:
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
  /// Quantities that count and of which nothing is known there: no value, or on too few meshes for a band.
  std::vector<std::string> without_band(const RungSpec& spec) const;
  /// The coarsest mesh with that accuracy, up to `farthest` times finer than any made.
  std::optional<double> refine_for(double accuracy) const;
  /// Whether one of the meshes that were made, or one between them, has that accuracy.
  bool is_reached(double accuracy) const;
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

/// Quantities without a value on three rungs are left out, and named in `notes`.
Price price_of(const std::vector<Rung>& rungs, const std::vector<PriceQuantity>& quantities, int dimension,
               std::vector<std::string>& notes);
/// Fills the rows of the price and of its quantities, when it knows what nodes its scene expects: each is a search over bands.
void list_rows(Price& price);

/// Of a scene at refine = 1, whatever its title and output: FNV-1a, 16 hexadecimal digits.
std::string digest_of_scene(const std::filesystem::path& scene, std::vector<std::string> set);

}  // namespace splashdown::apps
