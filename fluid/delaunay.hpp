// Delaunay triangulation of the nodes (CGAL, plain, never Alpha_shape_*: that sorts all alpha values).
// O(n log n); 0.5 us a node in 2D, 4 us in 3D on a 2.6 GHz core.
//
// In 2D the facets of the fluid's boundary are kept as edges (constrained Delaunay): without that, thin
// jets and thin bodies lose facets to nodes on their other side and their volume with them. Few facets
// are not Delaunay anyhow, so the constraint costs next to nothing. Facets that cross are left out.
// CGAL has no constrained triangulation in 3D.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/mesh.hpp"

namespace splashdown::fluid {

template <int d>
struct Delaunay {
  std::vector<std::array<int, d + 1>> cells;       ///< positively oriented
  std::vector<std::array<int, d + 1>> neighbours;  ///< cell opposite to each corner, -1 beyond the hull
};

/// Points that coincide with an earlier one belong to no cell.
template <int d>
Delaunay<d> delaunay(std::span<const Vec<d>> points, const std::vector<Facet<d>>& facets);

/// Order of the points along a space-filling curve.
template <int d>
std::vector<std::size_t> spatial_order(std::span<const Vec<d>> points);

}  // namespace splashdown::fluid
