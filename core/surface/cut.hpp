// What of a closed surface lies in a box: terrain in its tank.
#pragma once

#include <Eigen/Geometry>

#include "core/types.hpp"

namespace splashdown {

/// The boundary of the part of a solid that lies in `box` [m], normals outward; no facets where nothing of it does. `surface`:
/// closed, normals outward, without crossings. New vertices lie exactly in the sides of the box. By CGAL's corefinement, exact
/// predicates; O(n log n). Throws SurfaceFileError where what is left is not the surface of a solid.
Surface<3> cut_at_box(const Surface<3>& surface, const Eigen::AlignedBox3d& box);

}  // namespace splashdown
