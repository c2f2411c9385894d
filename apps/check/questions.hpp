// What a scene says and probably does not mean: asked before it is run, never forbidden.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/check/cost.hpp"

namespace splashdown::apps {

/// Each a line "key = value: what follows from it: did you mean ...?". None for a scene without slips.
template <int d>
std::vector<std::string> questions(const Scene& scene, const Cost& cost);

/// Memory that a run takes without being asked for it [B].
inline constexpr double memory_unasked = 4e9;
/// Why a run must be asked for with --large; nothing if it need not.
std::optional<std::string> too_large(const Cost& cost);

}  // namespace splashdown::apps
