// ablation.csv, ablation.json and ablation.svg, and what the console says.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/ablate/changes.hpp"

namespace splashdown::apps {

/// A row for each variant and quantity.
std::string ablation_csv(const AblationPlan& plan, const Ablation& ablation);
std::string ablation_json(const AblationPlan& plan, const Ablation& ablation, double least);
/// Verdicts, then all changes side by side.
std::string ablation_text(const AblationPlan& plan, const Ablation& ablation);

/// Draws the chart into FOLDER; a note if it could not.
std::optional<std::string> draw_ablation(const AblationPlan& plan, const Ablation& ablation, double least,
                                         const std::filesystem::path& folder);

}  // namespace splashdown::apps
