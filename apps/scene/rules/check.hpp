// Rules that bind several keys of a scene, or need its geometry.
#pragma once

#include "apps/scene/rules/problems.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// How messages call the elements of arrays of tables, e.g. `body.wedge`, `fluid.region[0]`.
struct SceneLabels {
  std::vector<std::string> bodies, joints, regions, records, limits;
};

/// The one place where checking asks for the dimension.
void check_scene(const Scene& scene, const SceneLabels& labels, Problems& problems);

// Its parts.
template <int d>
void check_fluid(const Scene& scene, const SceneLabels& labels, Problems& problems);
/// Of plane scenes; in space there is no such fluid.
void check_vortex(const Scene& scene, const SceneLabels& labels, Problems& problems);
/// The same of a fluid between sides on a mesh that moves.
void check_ale(const Scene& scene, const SceneLabels& labels, Problems& problems);
void check_joints(const Scene& scene, const SceneLabels& labels, Problems& problems);
template <int d>
void check_bodies(const Scene& scene, const SceneLabels& labels, Problems& problems);
void check_limits(const Scene& scene, const SceneLabels& labels, Problems& problems);
template <int d>
void check_records(const Scene& scene, const SceneLabels& labels, Problems& problems);

}  // namespace splashdown::apps
