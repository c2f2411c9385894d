#include "apps/commands.hpp"

#include <fmt/format.h>

#include <sstream>

#include "apps/plain_text.hpp"

namespace splashdown::apps {

int bad_input(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print(stderr, "error: {}\n", one_line(line));
  return exit_code::bad_input;
}

std::filesystem::path default_directory(const std::filesystem::path& scene) {
  const auto whole = std::filesystem::absolute(scene).lexically_normal();
  const bool by_folder = whole.filename() == "scene.toml" || whole.filename() == "study.toml";
  const auto name = by_folder ? whole.parent_path().filename() : whole.stem();
  return std::filesystem::path("out") / (name.empty() ? std::filesystem::path("scene") : name);
}

}  // namespace splashdown::apps
