// The folder that a run's files go to: which one it is by default, and whether it holds something else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace splashdown::apps {

/// out/FOLDER for scene.toml and study.toml, out/FOLDER_NAME for other files, FOLDER being theirs; out/NAME where the
/// file lies in the present folder or NAME begins with FOLDER.
std::filesystem::path default_directory(const std::filesystem::path& scene);

/// Why no files can be written into this folder, or why it cannot be made; nothing if they can. Nothing is written to find out.
std::optional<std::string> unwritable(const std::filesystem::path& directory);

/// What a run would replace that is not its own: results of another scene, a study, files of somebody else. A
/// message for users that says
/// both and what to do; nothing if there is nothing.
std::optional<std::string> foreign_results(const std::filesystem::path& directory, const std::filesystem::path& scene,
                                           const std::string& resolved);

/// scene.resolved.toml: the scene with all values in force, and what made it. Throws std::runtime_error.
void write_resolved(const std::filesystem::path& directory, const std::filesystem::path& scene,
                    const std::string& resolved);

}  // namespace splashdown::apps
