// What fluid.size.refine has divided, of any fluid, and body.elastic.refine where there is none.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Keys that refine a scene's meshes; empty: it has none.
inline std::vector<std::string> refine_keys(const Scene& scene) {
  if (scene.has_fluid()) return {"fluid.size.refine"};
  std::vector<std::string> keys;
  for (const auto& body : scene.bodies)
    if (body.deforms) keys.push_back("body." + body.name + ".elastic.refine");
  return keys;
}

/// Of the first body that deforms, else 1.
inline double refine_of_solids(const Scene& scene) {
  const auto body = std::ranges::find(scene.bodies, true, &Body::deforms);
  return body == scene.bodies.end() ? 1 : body->refine;
}

/// fluid.size.refine of a mesh or of a grid; without a fluid that of the first body that deforms, else 1.
inline double refine_of(const Scene& scene) {
  return scene.fluid    ? scene.fluid->size.refine
         : scene.vortex ? scene.vortex->refine
         : scene.ale    ? scene.ale->refine
                        : refine_of_solids(scene);
}

}  // namespace splashdown::apps
