// A run's state on disk: written whole or not at all, the one before kept.
//
//   checkpoint/state  the newest        checkpoint/previous  the one before
//
// New states are written beside, synced, and renamed into place, so that a kill at any moment leaves a good
// one.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/simulation/steps.hpp"

namespace splashdown::apps {

struct Checkpoint {
  std::string scene;  ///< resolved TOML of the run that wrote it
  LoopState loop;
  double time = 0;                       ///< simulated [s]
  double wall_seconds = 0;               ///< spent until then
  double processor_seconds = 0;          ///< the same on processors
  std::map<std::string, double> phases;  ///< seconds each until then
  std::string stepper, recorder;         ///< what their save() wrote
};

/// The simulated state again, without its records. Throws std::runtime_error for one of another world, or that contradicts itself.
void put_back(const Checkpoint& from, coupling::Stepper& stepper, LoopState& loop);

/// Throws std::runtime_error with the cause if the disk refuses.
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

struct StoredCheckpoint {
  std::filesystem::path file;
  Checkpoint state;
};

struct StoredCheckpoints {
  std::vector<StoredCheckpoint> good;  ///< the newest first
  std::vector<std::string> bad;        ///< files that cannot be used, each with its reason
};

/// What lies in a run's checkpoint folder. Never throws for what a file holds, whatever its bytes are.
StoredCheckpoints read_checkpoints(const std::filesystem::path& folder);

}  // namespace splashdown::apps
