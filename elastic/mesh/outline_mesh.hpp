// The mesh of a plane body: its outline filled by Delaunay refinement (Shewchuk 2002, in CGAL), no angle below 20.7 degrees
// but where the outline itself has one.
#pragma once

#include <functional>

#include "elastic/mesh/inner_lines.hpp"

namespace splashdown::elastic {

/// Edges of triangles are at most `size` long [m], and lie along `lines` where these are inside. Throws MeshError for an
/// outline that crosses itself.
SolidMesh<2> outline_mesh(const Surface<2>& outline, double size, const InnerLines& lines = {});
/// The same where the longest edge is a function of the place, positive.
SolidMesh<2> outline_mesh(const Surface<2>& outline, const std::function<double(const Vec<2>&)>& size,
                          const InnerLines& lines = {});

}  // namespace splashdown::elastic
