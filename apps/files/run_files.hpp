// The files of a run's folder.
#pragma once

#include <filesystem>
#include <string>

namespace splashdown::apps {

/// Whether a run has left rows here.
bool holds_tables(const std::filesystem::path& directory);

/// The tables that a recorder writes.
bool is_table(const std::string& file_name);

/// Removes what a recorder or a report may have left, and nothing else.
void clear_earlier_run(const std::filesystem::path& directory);

}  // namespace splashdown::apps
