// Threads of a run. Its results do not depend on their number.
#pragma once

#include <optional>

namespace splashdown::apps {

/// Not asked for: one in the plane, where runs are small and studies run side by side; all cores in space.
void set_threads(std::optional<int> count, int dimension);

}  // namespace splashdown::apps
