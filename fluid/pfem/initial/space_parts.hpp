// The steps of the start in 3D: walls cut the liquid, its skin is cleaned and drawn, Mesh_3 fills it. Three sources, because
// each of the first and the last takes a gigabyte and more to compile.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <functional>
#include <vector>

#include "fluid/pfem/initial/parts.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"

namespace splashdown::fluid {

/// Exact predicates, rounded coordinates.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// A triangle mesh with rounded coordinates.
using Rounded = CGAL::Surface_mesh<Kernel::Point_3>;

/// The same point [m].
inline Vec<3> vec(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Creases of the skin, which the mesh keeps to.
struct Curves {
  std::vector<std::vector<Kernel::Point_3>> lines;
  std::vector<Kernel::Point_3> corners;  // on no line
};

/// What walls leave of the liquid, cut exactly and then rounded. No facets: nothing.
Surface<3> clipped(const LiquidSpec<3>& liquid, const WallsAt<3>& walls);

/// Adds the mesh of what is inside `skin`, sized by `field`, that keeps to the curves. `meanwhile` is called for each size
/// that is asked for, if there is one.
void fill_within(const Rounded& skin, const Curves& curves, const SizeField<3>& field, const WallsAt<3>& walls,
                 const std::function<void()>& meanwhile, InitialLiquid<3>& out);

}  // namespace splashdown::fluid
