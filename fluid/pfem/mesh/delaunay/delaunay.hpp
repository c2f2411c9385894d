// Delaunay triangulation of the nodes (CGAL, plain, never Alpha_shape_*: that sorts all alpha values).
// O(n log n); 1 us a node in 2D, 4 us in 3D on a 2.6 GHz core.
//
// In 2D the facets of the fluid's boundary are kept as edges (constrained Delaunay): without that, thin
// jets and thin bodies lose facets to nodes on their other side and their volume with them. Few facets
// are not Delaunay anyhow, so the constraint costs next to nothing. Facets that cross are left out.
// In 3D the facets are ignored: there a triangulation that holds them may not exist (Schoenhardt 1928).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"

namespace splashdown::fluid {

/// Whether triangulations hold the facets that they are given as far as these do not cross; the first of two that do.
template <int d>
inline constexpr bool keeps_facets = d == 2;

/// Cells of a triangulation, and which ones are beside each other.
template <int d>
struct Delaunay {
  std::vector<std::array<int, d + 1>> cells;       ///< positively oriented
  std::vector<std::array<int, d + 1>> neighbours;  ///< cell opposite to each corner, -1 beyond the hull
  std::vector<std::array<int, d + 1>> at_hubs;     ///< cells with hubs (hubs.hpp), which are numbered after the points
  int first_hub = 0;
};

/// Points that coincide with an earlier one belong to no cell. In 3D some cells at the hull are missing: those with
/// circumspheres many times larger than all points together.
template <int d>
Delaunay<d> delaunay(std::span<const Vec<d>> points, const std::vector<Facet<d>>& facets);

/// With d + 1 points far away, so that all others lie within, and every facet between them has two cells. Cells whose
/// circumspheres are many times larger than what they span together miss: none of them is fluid.
template <int d>
struct ClosedDelaunay {
  /// Four numbers in 3D, three in 2D: of corners, or of cells opposite to them.
  using Cell = std::array<int, d + 1>;
  static constexpr int far = d + 1;  ///< points far away, numbered after all others; then comes the vertex at infinity
  static constexpr int gone = -1;    ///< first corner of a cell that sorting drops
  std::vector<Cell> cells, neighbours;  ///< sorted by their corners, those that reach far away come last
  std::size_t near = 0;                 ///< cells between the points themselves
  double extent = 0;                    ///< a power of two: largest coordinate of points is below it [m]
  bool complete = false;                ///< every point is a corner
};
/// The closed triangulation of the points and d + 1 more that lie far away. O(n log n).
template <int d>
ClosedDelaunay<d> closed_delaunay(std::span<const Vec<d>> points);
/// The power of two above all coordinates [m].
template <int d>
double extent_of(std::span<const Vec<d>> points);
/// The corners far away, for points of this extent [m].
template <int d>
std::array<Vec<d>, d + 1> far_points(double extent);
/// Sorts the corners of cells and the cells: where points follow a space-filling curve, cells near each other are near
/// in memory.
template <int d>
void sort_cells(ClosedDelaunay<d>& mesh, std::size_t points);
/// The cells between the points themselves, the last `hubs` of which are hubs; in 2D with the facets as edges.
template <int d>
Delaunay<d> near_part(const ClosedDelaunay<d>& mesh, std::span<const Vec<d>> points,
                      const std::vector<Facet<d>>& facets, std::size_t hubs = 0);

/// Order of the points along a space-filling curve.
template <int d>
std::vector<std::size_t> spatial_order(std::span<const Vec<d>> points);

}  // namespace splashdown::fluid
