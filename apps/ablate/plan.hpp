// The runs of an ablation: the scene as it is, with each effect that it has taken away, with those that are advised added, and with
// its modelling choices toggled; each on three meshes of nearly the same size. All together are a study.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/price/quantities.hpp"
#include "apps/scene/outlook/advice.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {

enum class VariantKind { scene, without, with, choice };
/// "scene", "without", "with", "choice"
const char* word(VariantKind kind);

struct Variant {
  std::string name;  ///< of its runs
  VariantKind kind = VariantKind::scene;
  std::string what;                ///< the effect or the choice
  std::vector<std::string> set;    ///< what makes it of the scene
  std::optional<Advised> advised;  ///< of an effect
};

struct AblationOrder {
  std::filesystem::path scene = {};
  std::vector<std::string> set = {};
  std::vector<std::string> quantities = {};  ///< as of `splashdown price`
  bool all = false;                          ///< adds what is not advised, too
  std::vector<std::string> only = {};        ///< names of effects and choices; empty: all
};

struct AblationPlan {
  std::string title;
  int dimension = 2;
  double length = 0, speed = 0, load = 0;  ///< what numbers are small beside [m, m/s, N or N/m]
  std::vector<Variant> variants;           ///< the scene itself first
  std::vector<PriceQuantity> quantities;
  Study study;  ///< axes: variant, refine
  std::vector<StudyRun> runs;
  std::vector<std::string> notes;  ///< variants that the scene does not allow, and why

  std::size_t replicates() const { return study.axes.back().values.size(); }
  /// Of the study's runs.
  std::size_t run_of(std::size_t variant, std::size_t replicate) const { return variant * replicates() + replicate; }
  bool has_band() const { return replicates() > 1; }
};

/// Throws SceneError.
AblationPlan plan_ablation(const AblationOrder& order);

}  // namespace splashdown::apps
