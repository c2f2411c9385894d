#include "fluid/pfem/mesh/recognition/at_walls.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::fluid {
namespace {

constexpr double solid_depth = 0.02;  // centroids this deep in a wall, over h, belong to no fluid cell
constexpr double facet_sag = 0.1;     // gap between a wetted facet and its wall, at most, over its length

// A chord of the wall: its nodes lie on one smooth patch, or on the rim of it, which looks the way there that the facet does. (Those
// on the far side of a thin hull look the other way.) `towards`: a point that the facet looks to.
template <int d>
bool faces_as(int wall, const Facet<d>& f, const Vec<d>& towards, const Nodes<d>& nodes, const WallsAt<d>& at) {
  constexpr double least_cosine = 0.26;  // 75 degrees: two nodes beside the tip of a cone that are nearly across it
  const Wall<d>& of = at.walls[wall];
  const auto x = corners_of<d>(f, nodes.x);
  Vec<d> normal = area_vector(x).normalized();
  if (normal.dot(towards - x[0]) < 0) normal = -normal;
  int patch = -1;
  for (int n : f.nodes) {
    if (nodes.tie[n].sharp()) continue;
    if (patch >= 0 && nodes.tie[n].patch != patch) return false;
    patch = nodes.tie[n].patch;
  }
  return patch >= 0 && std::ranges::all_of(f.nodes, [&](int n) {
           const auto near = of.nearest_on_patch(at.poses[wall], nodes.x[n], patch);
           if (nodes.tie[n].sharp()) return std::abs(near.distance) < facet_meet * of.diameter();
           return near.normal.dot(normal) > least_cosine;
         });
}

// How deep the facet of `wall` that the cell stands on lies in the solid: a chord, if the hull is convex. None, if the wall did not
// wet it before and it looks like no chord of it: it may cut the hull.
template <int d>
double chord_depth(int wall, const std::array<int, d + 1>& cell, const Nodes<d>& nodes,
                   const std::vector<Facet<d>>& old_boundary, const WallsAt<d>& at) {
  int off = 0;
  while (nodes.tie[cell[off]].wall == wall) ++off;
  const Facet<d> facet{facet_nodes(cell, off)};
  auto of_facet = [&](int n) { return std::ranges::find(facet.nodes, n) != facet.nodes.end(); };
  const bool wetted = std::ranges::any_of(
      old_boundary, [&](const Facet<d>& f) { return f.wall == wall && std::ranges::all_of(f.nodes, of_facet); });
  if (!wetted && !faces_as<d>(wall, facet, nodes.x[cell[off]], nodes, at)) return 0;
  Vec<d> centre = Vec<d>::Zero();
  for (int n : facet.nodes) centre += nodes.x[n] / d;
  return -at.walls[wall].nearest(at.poses[wall], centre, at.walls[wall].diameter()).distance;
}

template <int d>
double longest_edge(const Facet<d>& f, const Nodes<d>& nodes) {
  double longest = 0;
  for (int a = 0; a < d; ++a)
    for (int b = a + 1; b < d; ++b) longest = std::max(longest, (nodes.x[f.nodes[b]] - nodes.x[f.nodes[a]]).norm());
  return longest;
}

}  // namespace

template <int d>
bool lies_on(int wall, const Facet<d>& f, const Nodes<d>& nodes, const WallsAt<d>& at) {
  const double length = longest_edge(f, nodes);
  Vec<d> centre = Vec<d>::Zero();
  int patch = -1;
  bool one_patch = true, at_vertex = false, is_tied_whole = true;
  for (int n : f.nodes) {
    centre += nodes.x[n] / d;
    const WallTie& tie = nodes.tie[n];
    is_tied_whole = is_tied_whole && tie.wall == wall;
    if (tie.wall != wall) {
      if (tie.wall < 0 || at.walls[wall].distance_unsigned(at.poses[wall], nodes.x[n], length) >= facet_meet * length)
        return false;
      at_vertex = true;
      continue;
    }
    one_patch = one_patch && (patch < 0 || patch == tie.patch);
    patch = tie.patch;
    at_vertex = at_vertex || tie.sharp();
  }
  // Chords of a convex hull lie in the solid, however deep: no air is there to be a surface to. Beyond it none cuts a corner.
  if (at.walls[wall].is_convex() && is_tied_whole) return true;
  const bool cuts_corner = d == 2 && !one_patch && !at_vertex;
  return at.walls[wall].nearest(at.poses[wall], centre, length).distance < (cuts_corner ? 0 : facet_sag * length);
}

template <int d>
int wall_of(const Facet<d>& f, const Nodes<d>& nodes, const WallsAt<d>& at) {
  for (int k = 0; k < d; ++k) {
    const int wall = nodes.tie[f.nodes[k]].wall;
    if (wall < 0) return -1;
    if (k > 0 && wall == nodes.tie[f.nodes[k - 1]].wall) continue;
    if (lies_on(wall, f, nodes, at)) return wall;
  }
  return -1;
}

// One that stands on a chord of a convex hull reaches into the hull with it; one with all its nodes on the wall lies between a
// chord and the hull.
template <int d>
bool in_solid(const std::array<int, d + 1>& cell, const Vec<d>& centroid, double size, const Nodes<d>& nodes,
              const std::vector<Facet<d>>& old_boundary, const WallsAt<d>& at) {
  for (int k = 0; k <= d; ++k) {
    const int w = nodes.tie[cell[k]].wall;
    if (w < 0 || (k > 0 && w == nodes.tie[cell[k - 1]].wall)) continue;
    if (!at.walls[w].may_touch(at.poses[w], centroid, 0)) continue;
    const double deeper =
        -at.walls[w].nearest(at.poses[w], centroid, at.walls[w].diameter()).distance - solid_depth * size;
    if (deeper <= 0) continue;
    const auto on_wall = std::count_if(cell.begin(), cell.end(), [&](int n) { return nodes.tie[n].wall == w; });
    if (on_wall != d || deeper > chord_depth<d>(w, cell, nodes, old_boundary, at)) return true;
  }
  return false;
}

#define SPLASHDOWN_INSTANTIATE(d)                                                                  \
  template bool lies_on<d>(int, const Facet<d>&, const Nodes<d>&, const WallsAt<d>&);              \
  template int wall_of<d>(const Facet<d>&, const Nodes<d>&, const WallsAt<d>&);                    \
  template bool in_solid<d>(const std::array<int, d + 1>&, const Vec<d>&, double, const Nodes<d>&, \
                            const std::vector<Facet<d>>&, const WallsAt<d>&);
SPLASHDOWN_INSTANTIATE(2)
SPLASHDOWN_INSTANTIATE(3)
#undef SPLASHDOWN_INSTANTIATE

}  // namespace splashdown::fluid
