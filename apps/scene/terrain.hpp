// Fixed bodies that reach beyond the tank: sea floor, ramps, quays. What of them lies in the tank bounds the water.
#pragma once

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

class Problems;
struct SceneLabels;

/// Cuts fixed bodies at the tank: their shapes become what lies in it. Those that lie in it altogether, or nowhere, stay as they are,
/// and those a hundred times as large. A problem where what is left in the plane falls into parts. Bodies that could not be read are
/// left alone.
void cut_terrain(Scene& scene, const SceneLabels& labels, Problems& problems);

}  // namespace splashdown::apps
