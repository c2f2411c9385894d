// The mesh coloured by pressure at a handful of recorded instants.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::apps {

struct FieldFigure {
  std::string name;     ///< of its .png in the report's folder
  std::string title;    ///< "Peak load"
  std::string caption;  ///< HTML
  std::string script;   ///< for gnuplot
};

struct FieldFigures {
  std::vector<FieldFigure> figures;
  std::vector<std::string> warnings;
};

/// Start, largest load and end from DIR/snapshots, and frames between them from DIR/frames. Writes the data
/// files into `folder`.
FieldFigures prepare_field_figures(const std::filesystem::path& run, const std::filesystem::path& folder);

/// Removes the data files, which are large.
void remove_field_data(const std::filesystem::path& folder, const FieldFigures& figures);

}  // namespace splashdown::apps
