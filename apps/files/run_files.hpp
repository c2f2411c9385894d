// The files of a run's folder.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace splashdown::apps {

/// Whether a run has left rows here.
bool holds_tables(const std::filesystem::path& directory);

/// Names of the tables that a recorder writes, in the order in which people are told of them.
std::span<const char* const> run_tables();
/// Whether it is one of them.
bool is_table(const std::string& file_name);

/// Removes what a recorder or a report may have left, and nothing else.
void clear_earlier_run(const std::filesystem::path& directory);

}  // namespace splashdown::apps
