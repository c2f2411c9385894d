// Whether a scene is its own mirror image: then what acts across the mirror is an error of the mesh, whose triangles are not.
#pragma once

#include <vector>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// For each horizontal axis, whether the upright plane across it through the middle of the body is one of symmetry, of hull,
/// mass, motion, water, tank and gravity. Scenes of several bodies have none.
template <int d>
std::vector<char> symmetric_axes(const Scene& scene, const Body& body);

}  // namespace splashdown::apps
