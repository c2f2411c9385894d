// The highest pressures all over the hulls: curves along outlines, pictures of surfaces.
#pragma once

#include <filesystem>

#include "apps/report/figures.hpp"
#include "apps/report/pictures/field.hpp"

namespace splashdown::apps {

/// From DIR/hull_*.vtu: of outlines, over the distance from the keel.
FigureGroup hull_curves(const std::filesystem::path& run);

/// The same of surfaces: each hull from below, from the side and from ahead.
FieldFigures prepare_hull_figures(const std::filesystem::path& run);

}  // namespace splashdown::apps
