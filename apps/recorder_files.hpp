// The files of a run's folder.
#pragma once

#include <filesystem>

namespace splashdown::apps {

/// Removes what a recorder or a report may have left, and nothing else.
void clear_earlier_run(const std::filesystem::path& directory);

}  // namespace splashdown::apps
