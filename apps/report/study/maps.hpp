// What a study found, as a picture of its own quantities: a heat map over two axes, lines over one of numbers, bars over words.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/gnuplot.hpp"

namespace splashdown::apps {

/// A column of study.json.
struct StudyColumn {
  std::string name, label;
  bool own = false;  ///< a quantity of the study's, or its error; others are those of every study
};

/// Those in which any run has a number: the study's own first.
std::vector<StudyColumn> study_columns(const nlohmann::ordered_json& study);

/// A table a quantity, coloured, each cell leading to its run's report; HTML. Nothing without two axes of numbers, or two of words.
std::string heat_maps(const std::filesystem::path& directory, const nlohmann::ordered_json& study);

/// A row a run with a bar a quantity, each leading to the run's report; HTML. Nothing where an axis is of numbers, or there is a map.
std::string study_bars(const std::filesystem::path& directory, const nlohmann::ordered_json& study);

/// A figure a quantity over the first axis of numbers, a curve for each combination of the others, each point leading to its run's report.
/// None where there is a heat map, or no such axis.
std::vector<Figure> study_lines(const std::filesystem::path& directory, const nlohmann::ordered_json& study);

}  // namespace splashdown::apps
