// `splashdown render`: a still or a film of a run's frames, without a display.
#pragma once

#include "apps/render/plan.hpp"

namespace splashdown::apps {

/// Draws the replay of the report in a headless Chromium. Returns the exit code of the program (process/exit.hpp): what is
/// asked for is checked first, what the browser or ffmpeg cannot do is cannot_go_on. Files are there whole or not at all.
int render_command(const RenderOptions& options);

}  // namespace splashdown::apps
