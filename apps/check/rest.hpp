// How the bodies of a scene come to rest on still water, with all that holds them.
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/scene.hpp"
#include "rigid/rest.hpp"

namespace splashdown::apps {

template <int d>
struct Resting {
  rigid::BodySpec<d> spec;
  rigid::Hollow hollow = rigid::Hollow::dry;  ///< at t = 0: flooded if a region reaches into it
  bool filled = false;                        ///< a region does
  std::optional<rigid::Floating<d>>
      floats;  ///< of one that is free to heave and to tilt and meets nothing; absent: sinks
  /// Of one that a joint ties, that is not free to heave and to tilt, or that meets another body or the tank.
  std::optional<rigid::BodyAtRest<d>> held;
};

/// Of all bodies that move freely and have a mass; absent for others, and without liquid or gravity that points down.
template <int d>
std::vector<std::optional<Resting<d>>> at_rest(const Scene& scene);

}  // namespace splashdown::apps
