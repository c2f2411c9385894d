// What a run tells people at its end.
#pragma once

#include <filesystem>
#include <string>

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// A value with a metric prefix: 26745.8 N/m -> "26.75 kN/m", 0.014872 s -> "14.87 ms".
std::string with_unit(double value, const std::string& unit);

enum class Ink { plain, colour };  ///< colour: ANSI sequences, for a terminal

/// Several lines: outcome, bodies, liquid, coupling, time spent, files; the verdict last.
std::string closing_text(const Summary& summary, const std::filesystem::path& directory, Ink ink = Ink::plain);

}  // namespace splashdown::apps
