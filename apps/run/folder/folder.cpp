#include "apps/run/folder/folder.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "apps/files/csv.hpp"
#include "apps/files/run_files.hpp"
#include "apps/process/version.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

/// The same for all ways that lead to a file.
fs::path whole(const fs::path& file) { return fs::weakly_canonical(fs::absolute(file)); }

/// The [provenance] table of scene.resolved.toml; `scene`: the file that was run.
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

/// What a run removes before it begins, or writes over.
std::vector<const char*> replaced() {
  std::vector<const char*> names{"checkpoint"};
  for (const char* name : run_tables()) names.push_back(name);
  names.insert(names.end(), {"summary.json", "report.html", "frames.pvd", "frames", "snapshots", "report"});
  return names;
}

struct Origin {
  std::string text;         ///< all of scene.resolved.toml
  std::string title, file;  ///< empty: not known
};

Origin origin_of(const fs::path& directory) {
  std::ifstream in(directory / "scene.resolved.toml", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  Origin origin{text.str(), {}, {}};
  try {
    const auto table = toml::parse(origin.text);
    origin.title = table["title"].value_or(std::string());
    origin.file = table["provenance"]["scene"].value_or(std::string());
  } catch (const toml::parse_error&) {  // nothing is known of it then
  }
  return origin;
}

std::string described(const std::string& title, const std::string& file) {
  if (title.empty() && file.empty()) return "an unknown scene";
  if (title.empty()) return one_line(file);
  return fmt::format("'{}'{}", one_line(title), file.empty() ? "" : " (" + one_line(file) + ")");
}

}  // namespace

fs::path default_directory(const fs::path& scene) {
  const auto file = fs::absolute(scene).lexically_normal();
  const auto folder = file.parent_path().filename().string(), name = file.stem().string();
  const bool by_folder = file.filename() == "scene.toml" || file.filename() == "study.toml";
  const bool here = file.parent_path() == fs::current_path();
  if (by_folder) return fs::path("out") / (folder.empty() ? "scene" : folder);
  const bool told = folder.empty() || here || name == folder || name.starts_with(folder + "_");
  return fs::path("out") / (told ? name : folder + "_" + name);
}

std::optional<std::string> unwritable(const fs::path& directory) {
  std::error_code unknown;
  fs::path there = fs::absolute(directory).lexically_normal();
  while (!fs::exists(there, unknown) && there.has_relative_path()) there = there.parent_path();
  const char* cure = "Use another --out, a folder that you may write to.";
  if (!fs::is_directory(there, unknown))
    return fmt::format("{}: {} is a file, where a folder is needed. {}", directory.string(), there.string(), cure);
  if (::access(there.c_str(), W_OK | X_OK) == 0) return {};
  return fmt::format("{}: files cannot be written{}: {}. {}", directory.string(),
                     there == fs::absolute(directory).lexically_normal() ? "" : " in " + there.string(),
                     std::strerror(errno), cure);
}

std::optional<std::string> foreign_results(const fs::path& directory, const fs::path& scene,
                                           const std::string& resolved) {
  const auto cure = "Use --out with another folder, or --force to replace it.";
  if (fs::exists(directory / "study.json")) return fmt::format("{} holds a study. {}", directory.string(), cure);
  if (fs::exists(directory / "price.json")) return fmt::format("{} holds a price list. {}", directory.string(), cure);
  if (!fs::exists(directory / "scene.resolved.toml")) {
    for (const char* name : replaced())
      if (fs::exists(directory / name))
        return fmt::format("{} holds {}, which would be replaced, but no scene.resolved.toml: no run has left it. {}",
                           directory.string(), name, cure);
    return {};
  }
  if (!fs::exists(directory / "summary.json") && !fs::exists(directory / "checkpoint" / "state")) return {};
  const auto there = origin_of(directory);
  const auto file = whole(scene).string();
  const auto title = toml::parse(resolved)["title"].value_or(std::string());
  // Runs of earlier versions do not say their file.
  const bool same = there.text.starts_with(resolved + "\n") || there.file == file ||
                    (there.file.empty() && !title.empty() && there.title == title);
  if (same) return {};
  return fmt::format("{} holds the results of another scene, {}; this one is {}. {}", directory.string(),
                     described(there.title, there.file), described(title, file), cure);
}

void write_resolved(const fs::path& directory, const fs::path& scene, const std::string& resolved) {
  write_file_atomically(directory / "scene.resolved.toml", resolved + "\n" + provenance_toml(whole(scene)));
}

}  // namespace splashdown::apps
