// `splashdown report`: report.html from the files of a folder.
#pragma once

#include <filesystem>

namespace splashdown::apps {

/// Returns the exit code of the program (process/exit.hpp).
int report_command(const std::filesystem::path& directory);

}  // namespace splashdown::apps
