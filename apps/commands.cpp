#include "apps/commands.hpp"

#include <fmt/format.h>

#include <sstream>

namespace splashdown::apps {

std::string trouble(const std::exception& error) {
  const auto* files = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (!files) return error.what();
  return fmt::format("{}: {}. Use another --out, a folder that you may write to.", files->path1().string(),
                     files->code().message());
}

int bad_input(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print(stderr, "error: {}\n", line);
  return exit_code::bad_input;
}

std::filesystem::path default_directory(const std::filesystem::path& scene) {
  const auto whole = std::filesystem::absolute(scene).lexically_normal();
  const bool by_folder = whole.filename() == "scene.toml" || whole.filename() == "study.toml";
  const auto name = by_folder ? whole.parent_path().filename() : whole.stem();
  return std::filesystem::path("out") / (name.empty() ? std::filesystem::path("scene") : name);
}

}  // namespace splashdown::apps
