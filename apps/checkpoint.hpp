// A run's state on disk: written whole or not at all, the one before kept.
//
//   checkpoint/state  the newest        checkpoint/previous  the one before
//
// New states are written beside, synced, and renamed into place, so that a kill at any moment leaves a good
// one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/run_loop.hpp"

namespace splashdown::apps {

struct Checkpoint {
  std::string scene;  ///< resolved TOML of the run that wrote it
  LoopState loop;
  double time = 0;                       ///< simulated [s]
  double wall_seconds = 0;               ///< spent until then
  std::map<std::string, double> phases;  ///< seconds each until then
  std::string stepper, recorder;         ///< what their save() wrote
};

/// Throws std::runtime_error with the cause if the disk refuses.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// The newest good state; nothing if there is none. Damaged files are passed over.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder);

}  // namespace splashdown::apps
