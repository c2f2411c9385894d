// What a scene will cost, judged before it is run.
#pragma once

#include "apps/scene.hpp"

namespace splashdown::apps {

struct Cost {
  double nodes = 0;             ///< at t = 0
  double bytes = 0;             ///< of memory
  double seconds_per_step = 0;  ///< on one core
  double dt = 0;                ///< at the characteristic speed [s]
  double steps = 0;
};

/// Nodes: the integral over the liquid of 2/(sqrt(3) h^2), what equilateral triangles of side h have, in three
/// dimensions of 1/h^3. Sizes are those of t = 0: what `hollow` adds and `wetted_fraction` saves later is not in it.
template <int d>
Cost predicted_cost(const Scene& scene);

}  // namespace splashdown::apps
