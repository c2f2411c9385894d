// What effects and choices do to the numbers of a scene and to its clock.
//
//   change = mean over the meshes of (y with - y without) / |mean of y in the scene as it is|
//   band   = t s / sqrt(n)
//
// y with, y without: on the same mesh, so that what both have of its error cancels. n meshes of nearly the same size; s: standard
// deviation of the changes on them; t: Student's, two-sided, 95 %. A value that is small beside the scene's scales is divided by a
// thousandth of those. Seconds are compared by their medians, within one ablation alone: they are those of one machine.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/ablate/plan.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {

enum class Meaning {
  none,     ///< no value, or one that scatters by more than half of itself
  small,    ///< below what matters, with its band
  unclear,  ///< the band is too wide to say
  matters   ///< above it, even less its band
};
/// "", "small", "unclear", "matters"
const char* word(Meaning meaning);

struct Change {
  double value = 0;            ///< mean of the variant [unit]; nan: none
  double relative = 0;         ///< nan: none
  std::optional<double> band;  ///< relative; absent: fewer than two meshes
  Meaning meaning = Meaning::none;
};

struct VariantResult {
  std::string cause;            ///< why it has no result; empty: it has
  std::vector<Change> changes;  ///< of the quantities
  std::optional<double> seconds, time_change;
  std::optional<std::size_t> deciding;  ///< quantity
  /// "keep" | "leave out" of effects, "matters" | "does not matter" of choices, "undecided"; empty: of the scene, and without a result
  std::string verdict;
  std::optional<bool> agrees;  ///< with what was advised; absent: nothing was, or doubtful, or undecided
};

struct Ablation {
  std::vector<PriceQuantity> quantities;
  std::vector<double> base;  ///< means in the scene as it is; nan: none
  std::vector<VariantResult> variants;
};

/// `least`: relative change that matters.
Ablation ablation_of(const AblationPlan& plan, const std::vector<Outcome>& outcomes,
                     const std::filesystem::path& folder, double least);

/// "gravity: +3.9 % ± 0.2 % wedge.peak_g_cfc60, +2 % time: keep"
std::string verdict_line(const AblationPlan& plan, const Ablation& ablation, std::size_t variant);
/// "+3.9 % ± 0.2 %"; "-" for none
std::string change_text(const Change& change);

}  // namespace splashdown::apps
