// Rules of clamps.
#pragma once

#include "apps/effects/elastic/elastic.hpp"
#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::apps {

class Problems;

/// What clamps hold and how they move, with the modes and schemes that ask for it; `mesh` in the shape's frame.
template <int d>
void check_clamps(const Scene& scene, const ElasticTable& table, const elastic::SolidMesh<d>& mesh, Problems& problems);

}  // namespace splashdown::apps
