#include "apps/cli/version.hpp"

#include <fmt/format.h>

#include "apps/cli/version_built.hpp"  // from version_built.hpp.in
#include "apps/scene/read/echo.hpp"

namespace splashdown::apps {

std::string version() { return built::version; }
std::string git_hash() { return built::git_hash; }

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {std::begin(built::libraries), std::end(built::libraries)};
}

std::string provenance_toml(const std::filesystem::path& scene) {
  auto text = fmt::format("[provenance]\nscene = {}\nversion = {}\ngit = {}\nlibraries = {{ ",
                          toml_text(scene.string()), toml_text(version()), toml_text(git_hash()));
  const char* separator = "";
  for (const auto& [name, number] : library_versions()) {
    text += fmt::format("{}{} = {}", separator, name, toml_text(number));
    separator = ", ";
  }
  return text + " }\n";
}

}  // namespace splashdown::apps
