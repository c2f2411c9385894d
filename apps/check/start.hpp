// What a run refuses before its first step, told within seconds: the same tests in `check` and at the start of `run`.
#pragma once

#include <functional>
#include <optional>

#include "apps/check/cost.hpp"
#include "fluid/pfem/initial/initial.hpp"

namespace splashdown::apps {

/// How to learn whether a gap is filled that a mesh may fail to fill.
enum class Doubt {
  mesh,    ///< by the mesh, where that takes seconds; refused where it takes longer
  leave,   ///< the same, but the mesh is somebody else's
  accept,  ///< whatever it takes
};

/// Throws std::invalid_argument for bodies, liquids and gaps that cannot be had, with the size that a gap needs and what that costs.
/// The narrowest gap that a mesh may fail to fill.
template <int d>
std::optional<fluid::Gap> check_start(const Scene& scene, const Cost& cost, Doubt doubt);

/// What `make` throws, with size and cost for a gap that a mesh did not fill. `doubtful`: what `check_start` found.
template <int d>
void tell_gaps(const Scene& scene, const std::optional<fluid::Gap>& doubtful, const std::function<void()>& make);

}  // namespace splashdown::apps
