// Free bodies that never moved though something pulled at them.
//
//   m (V(T) - V(0)) = I + m g T + R      I: impulse of the water's loads, R: of joints
//
// A body at rest in balance has R = 0. One that floor or hulls may carry is at rest with reason: nothing is said of scenes with
// [contact], of welds, of bodies that deform, which clamps may hold and patches load, and of directions in which a body is not
// free.
#pragma once

#include "apps/scene/scene.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// Sets `held_against`, |R|/T in free directions [N, N/m], of such bodies. `time`: T, over which `impulse` was summed [s].
template <int d>
void mark_held(const Scene& scene, double time, Summary& summary);

}  // namespace splashdown::apps
