// The next step of a run as a command that can be pasted: relative to this run, whatever its scene says.
#pragma once

#include <optional>
#include <string>

#include "apps/run/command.hpp"
#include "apps/scene/scene.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// What the run was called with, as a shell takes it.
std::string command_of(const RunOptions& options);

/// Fills command and seconds, and turns values into those of the command line: refine and dt_max times the refine of the run. The time is
/// that of this run times what `check` guesses of both; nothing is left if the scene does not allow the step.
void complete(std::optional<NextStep>& next, const RunOptions& options, const Scene& scene, double wall_seconds);

}  // namespace splashdown::apps
