// What a run tells people at its end.
#pragma once

#include <filesystem>
#include <string>

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

enum class Ink { plain, colour };  ///< colour: ANSI sequences, for a terminal

/// Several lines: outcome, bodies, liquid, coupling, time spent, files; the verdict last.
std::string closing_text(const Summary& summary, const std::filesystem::path& directory, Ink ink = Ink::plain);

}  // namespace splashdown::apps
