// What fluid.size.refine has divided, of any fluid.
#pragma once

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// fluid.size.refine of a mesh or of a grid; 1 without a fluid.
inline double refine_of(const Scene& scene) {
  return scene.fluid    ? scene.fluid->size.refine
         : scene.vortex ? scene.vortex->refine
         : scene.ale    ? scene.ale->refine
                        : 1;
}

}  // namespace splashdown::apps
