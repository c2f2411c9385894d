// Facets and cells at walls: which facets lie on a wall, which cells in the solid behind it.
//
// Facets between nodes of a curved wall are chords of it, so that cells which stand on them reach into the solid of a convex one.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "fluid/pfem/contact/wall.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Walls and where they are: wall frame to world. Refers to both.
template <int d>
struct WallsAt {
  std::span<const Wall<d>> walls;
  std::span<const WallPlace<d>> poses;
};

/// Whether nodes of a cell are tied to different walls. A tank's side in a plane of symmetry is none.
template <int d>
bool are_between_walls(const std::array<int, static_cast<std::size_t>(d) + 1>& cell, const Nodes<d>& nodes,
                       const WallsAt<d>& at) {
  int one = -1;
  return std::ranges::any_of(cell, [&](int n) {
    const WallTie& tie = nodes.tie[static_cast<std::size_t>(n)];
    const int wall = tie.wall >= 0 && at.walls[tie.wall].is_mirror(tie.patch) ? -1 : tie.wall;
    if (one < 0) one = wall;
    return wall >= 0 && wall != one;
  });
}

/// Nodes of another wall this close to a wall, over a facet's length, sit on both.
inline constexpr double facet_meet = 0.001;

/// Whether the facet lies on `wall`: its nodes are tied to it, or to another wall and sit where both meet, and its centre lies in
/// the solid or nearer to it than a tenth of its length.
template <int d>
bool lies_on(int wall, const Facet<d>& f, const Nodes<d>& nodes, const WallsAt<d>& at);

/// The wall that a facet of the liquid's boundary lies on, -1: it is free surface.
template <int d>
int wall_of(const Facet<d>& f, const Nodes<d>& nodes, const WallsAt<d>& at);

/// Whether a cell lies in the solid of a wall that it touches: its centroid is there, deeper than a fiftieth of its size, and
/// than the chord that it stands on, if that is one: a facet that the wall wetted before, or one that looks the way the wall
/// does at all its nodes. `size`: element size at it [m].
template <int d>
bool in_solid(const std::array<int, d + 1>& cell, const Vec<d>& centroid, double size, const Nodes<d>& nodes,
              const std::vector<Facet<d>>& old_boundary, const WallsAt<d>& at);

}  // namespace splashdown::fluid
