// `splashdown new`: a hull and how it lands, written as a scene that check and run take unchanged.
#pragma once

#include "apps/new/options.hpp"

namespace splashdown::apps {

/// Returns the exit code of the program (process/exit.hpp).
int new_command(const NewOptions& options);

}  // namespace splashdown::apps
