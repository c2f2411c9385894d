// Findings as rows of a file, and the page that is made from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/stability/ensemble/laws.hpp"

namespace splashdown::ensemble {

/// The value that 95 of 100 do not exceed, the largest of fewer than 20; nan counts as larger than all numbers.
double percentile_95(std::vector<double> values);

/// class,seed,what,law,measured,bound,verdict,wall_seconds,note; a row a finding, with a header if the file is new.
/// A run that was refused as it may be is one row of its own.
void append_rows(const std::filesystem::path& csv, const Member& member, const Run& run, const Verdict& verdict);

/// Writes the tables between the markers of the page, from the newest row of each member and law.
void write_page(const std::filesystem::path& csv, const std::filesystem::path& page);

}  // namespace splashdown::ensemble
