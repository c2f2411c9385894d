// Whether a checkpoint belongs to a scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/simulation/checkpoint.hpp"

namespace splashdown::apps {

/// Keys whose values differ between two resolved scenes and that the state of a run depends on: all but the
/// title, [time], [coupling] and the checkpoints' interval. Each as "key = now, key = then".
std::vector<std::string> differences(const std::string& resolved_now, const std::string& resolved_then);

/// The checkpoints of the run in a folder; none if no run has begun there. Throws SceneError if they were written by
/// another scene, and if what lies there cannot be continued: a run that is lost must not be replaced unasked.
StoredCheckpoints find_checkpoints(const std::filesystem::path& directory, const std::string& resolved);

/// What is told when no checkpoint of a folder can be used: the reasons, and what to do.
std::vector<std::string> unusable(const std::filesystem::path& directory, const std::vector<std::string>& reasons);

}  // namespace splashdown::apps
