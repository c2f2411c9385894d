// The mesh coloured by pressure at a handful of recorded instants.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace splashdown::apps {

struct FieldFigure {
  std::string name;     ///< of its .svg in the report's folder
  std::string title;    ///< "Peak load"
  std::string caption;  ///< HTML
  std::string script;   ///< that draws its axes
  std::string content;  ///< SVG between them
};

struct FieldFigures {
  std::vector<FieldFigure> figures;
  std::vector<std::string> warnings;
};

/// Start, largest load and end from DIR/snapshots, and frames between them from DIR/frames.
/// Pressures are those over water at rest, where `summary` says what that is ("still_water").
FieldFigures prepare_field_figures(const std::filesystem::path& run, const nlohmann::ordered_json& summary);

}  // namespace splashdown::apps
