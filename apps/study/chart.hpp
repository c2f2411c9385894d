// The chart of a study: small panels, rows by quantity and columns by the values of an axis.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/study/table.hpp"

namespace splashdown::apps {

/// The gnuplot script that draws study.svg and study.png. Runs that broke down stand as crosses in a band at
/// the top of their panel.
std::string chart_script(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes);

/// Draws the chart into FOLDER; a note if it could not.
std::optional<std::string> draw_chart(const Study& study, const std::vector<StudyRun>& runs,
                                      const std::vector<Outcome>& outcomes, const std::filesystem::path& folder);

}  // namespace splashdown::apps
