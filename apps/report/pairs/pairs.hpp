// Two runs of a study side by side: what differs, their numbers, their curves over each other, in the study's own page.
//
// A page that is opened from disk may not read files of other folders. What is compared is therefore in it: the numbers of all runs, and of
// their curves what the eye can see, fewer points a curve the more runs there are. Two runs are picked in the table of runs, or by name.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace splashdown::apps {

/// The section, hidden until the script has filled it, data and script behind it; HTML, nothing for one run. `charts`: the page has the
/// scripts that draw curves.
std::string pairs_of(const std::filesystem::path& directory, const nlohmann::ordered_json& study, bool charts);

/// JSON: {"columns": [[name, label]], "axes": [label], "curves": [{"x", "y"}], "runs": [{"name", "link", "status", "verdict", "axes": [text],
/// "numbers": {name: value}, "curves": {number of the curve: [x, y]}}]}.
std::string pairs_json(const std::filesystem::path& directory, const nlohmann::ordered_json& study);

/// The cell of the table of runs that picks one; for the script, so it is hidden.
std::string pick_cell(const std::string& run);

}  // namespace splashdown::apps
