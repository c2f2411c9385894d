// What this program was built from.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace splashdown::apps {

std::string version();   ///< of the release, e.g. "0.1.0"
std::string git_hash();  ///< of the source, "-dirty" behind it if that was changed; "unknown" outside a checkout
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace splashdown::apps
