// What a scene will cost, judged before it is run.
#pragma once

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

struct Cost {
  double nodes = 0;              ///< at t = 0
  double nodes_most = 0;         ///< of the run
  bool at_least = false;         ///< the scene asks for more nodes than are counted: all numbers are lower bounds
  bool without_hollows = false;  ///< what `hollow` adds is not in it
  double bytes = 0;              ///< of memory
  double seconds_to_start = 0;   ///< the first mesh and the first factor, on one core
  double seconds_per_step = 0;   ///< on one core, mean of the run
  double dt = 0;                 ///< at the characteristic speed [s]
  double steps = 0;
};

/// Nodes: the integral over the liquid of 2/(sqrt(3) h^2), what equilateral triangles of side h have, in three
/// dimensions of sqrt(2)/h^3, the closest packing. Boundaries, which have half a layer more, are not counted: a box of
/// 4 m x 4 m x 1 m at h = 0.1 m starts with 26534 nodes instead of 22627. Bodies
/// stand where `guessed_motion` puts them; what `hollow` adds is in it where a hull in the plane has a jet.
/// The work is bounded, whatever the sizes.
template <int d>
Cost predicted_cost(const Scene& scene);

/// Of the whole run on one core [s].
double predicted_seconds(const Scene& scene);

}  // namespace splashdown::apps
