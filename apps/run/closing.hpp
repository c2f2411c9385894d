// What a run tells people at its end.
#pragma once

#include <filesystem>
#include <string>

#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

struct MetricPrefix {
  double factor;
  const char* name;
};
/// G to u, so that the number before it is from 1 to 1000; none for what is smaller, zero or not a number.
MetricPrefix prefix_of(double value);

/// A value with a metric prefix: 26745.8 N/m -> "26.75 kN/m", 0.014872 s -> "14.87 ms".
std::string with_unit(double value, const std::string& unit);

enum class Ink { plain, colour };  ///< colour: ANSI sequences, for a terminal

/// Several lines: outcome, bodies, liquid, coupling, time spent, files; the verdict last.
std::string closing_text(const Summary& summary, const std::filesystem::path& directory, Ink ink = Ink::plain);

}  // namespace splashdown::apps
