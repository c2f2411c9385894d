// In 3D: what may stand in place of cells of the triangulation that pierce a wall.
//
// A node N of the water may be joined, through a facet of the wall, to a node Q of the wall behind an edge or on the far side
// of a thin body: Delaunay's criterion knows no walls. Cells around N Q then lie in the solid, and the water between N and
// the facet would be missing: a hole in the wetted wall, where p = 0. Flips bring the facet back (Joe 1991):
//
//   edge removal    m cells around an edge N Q  ->  fans of m - 2 cells at N and at Q over the ring of the others; 3-2 for m = 3
//   facet removal   two cells at a facet  ->  three around the edge between their other corners (2-3)
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/pfem/mesh/delaunay/delaunay.hpp"

namespace splashdown::fluid {

/// Cells that go, and those that fill the same room.
struct Flip {
  std::vector<int> cells;                 ///< that go
  std::vector<std::array<int, 4>> fresh;  ///< that fill their place; empty: nothing positive does
};

/// Without the edge between corners a and b of a cell. Of all fans the one with the fullest smallest cell.
Flip without_edge(const Delaunay<3>& mesh, std::span<const Vec<3>> x, int cell, int a, int b);
/// Without the facet opposite a corner.
Flip without_facet(const Delaunay<3>& mesh, std::span<const Vec<3>> x, int cell, int corner);
/// Does it. The numbers of the fresh cells; cells that are gone without one in their place have the corners -1.
std::vector<int> apply(const Flip& flip, Delaunay<3>& mesh);

}  // namespace splashdown::fluid
