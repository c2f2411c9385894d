// Whether a checkpoint belongs to a scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/checkpoint.hpp"

namespace splashdown::apps {

/// Keys whose values differ between two resolved scenes and that the state of a run depends on: all but the
/// title, [time], [coupling] and the checkpoints' interval. Each as "key = now, key = then".
std::vector<std::string> differences(const std::string& resolved_now, const std::string& resolved_then);

/// The newest good checkpoint of the run in a folder; nothing if there is none. Throws SceneError if it was
/// written by another scene.
std::optional<Checkpoint> find_checkpoint(const std::filesystem::path& directory, const std::string& resolved);

}  // namespace splashdown::apps
