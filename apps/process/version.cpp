#include "apps/process/version.hpp"

#include <iterator>

#include "apps/process/version_built.hpp"  // from version_built.hpp.in

namespace splashdown::apps {

std::string version() { return built::version; }
std::string git_hash() { return built::git_hash; }

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {std::begin(built::libraries), std::end(built::libraries)};
}

}  // namespace splashdown::apps
