// Verdicts as lines on the terminal, rows of validation.csv and the table of docs/validation.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/validation/judge.hpp"

namespace splashdown::validation {

/// One line: check, measured, expected, tolerance, verdict.
std::string line_of(const Verdict& verdict);

/// Appends one row; several test processes may write to the same file at once.
void append_row(const std::filesystem::path& csv, const Verdict& verdict);

/// Puts the newest row of every check into `page` between its two markers
///   <!-- validation table: begin -->   and   <!-- validation table: end -->
/// Examples that the file knows nothing of keep their rows.
void write_page(const std::filesystem::path& csv, const std::filesystem::path& page);

}  // namespace splashdown::validation
