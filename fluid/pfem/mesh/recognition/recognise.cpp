#include "fluid/pfem/mesh/recognition/recognise.hpp"

#include <algorithm>
#include <cmath>

#include "core/surface/inside.hpp"
#include "fluid/pfem/mesh/recognition/hubs.hpp"
#include "fluid/pfem/mesh/recognition/pierced.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr double degenerate = 1e-7;  // volume over longest edge^d below which a cell is degenerate
constexpr double dust = 2e-4;        // volume over h^d below which a cell is no liquid: films of a thousandth of h

// What a cell holds: cells without volume and all but without it are not asked whether it is water. Pinched ones are, but they
// are so thin between two walls that any facet of theirs may pass for one on a wall.
enum Content : char { none, flat_cell, thin_cell, pinched_water, water, enclosed_flat_cell };
bool is_filled(Content c) { return c >= water; }

struct Shape {
  double radius;    // circumradius
  double fullness;  // volume over longest edge^d
  bool degenerate;
};

template <int d>
Shape shape(const Mat<d>& J) {
  Vec<d> half;
  double longest = 0;
  for (int k = 0; k < d; ++k) {
    const double squared = J.col(k).squaredNorm();
    half[k] = 0.5 * squared;
    longest = std::max(longest, squared);
    for (int j = 0; j < k; ++j) longest = std::max(longest, (J.col(k) - J.col(j)).squaredNorm());
  }
  const double det = J.determinant();
  const double fullness = det / (factorial<d> * (d == 2 ? longest : longest * std::sqrt(longest)));
  if (fullness <= degenerate / factorial<d>) return {0, fullness, true};
  return {(cofactor(J) * half).norm() / det, fullness, false};
}

// In 3D: flat cells between four nodes of a wall that all their facets lie on. They hold no water to speak of, and
// their pressure would be anything. One in a hollow crease, between nodes of the patches beside it, would leave a hole in the
// water.
template <int d>
bool is_film(const std::array<int, d + 1>& cell, double fullness, const Nodes<d>& nodes, const WallsAt<d>& at) {
  constexpr double thin = 0.02;  // a regular tetrahedron: 0.12
  if (d == 2 || fullness > thin) return false;
  const int wall = nodes.tie[cell[0]].wall;
  if (wall < 0) return false;
  int patch = -1;
  bool one_patch = true;
  Vec<d> centroid = Vec<d>::Zero();
  for (int n : cell) {
    const WallTie& tie = nodes.tie[n];
    if (tie.wall != wall) return false;
    centroid += nodes.x[n] / (d + 1);
    if (tie.sharp()) continue;
    one_patch = one_patch && (patch < 0 || tie.patch == patch);
    patch = tie.patch;
  }
  for (int k = 0; k <= d; ++k)
    if (!lies_on(wall, Facet<d>{facet_nodes(cell, k)}, nodes, at)) return false;
  const Wall<d>& of = at.walls[wall];
  return one_patch || of.nearest(at.poses[wall], centroid, of.diameter()).distance < 0;
}

// Whether the nodes lie on two patches of a wall, off the edge between them.
bool joins_patches(const WallTie& a, const WallTie& b) {
  return a.wall >= 0 && a.wall == b.wall && !a.sharp() && !b.sharp() && a.patch != b.patch;
}

// Volume that a cell between nodes of a wall and of the water has in the solid, from five points in it.
double pierced(const std::array<int, 4>& cell, const Nodes<3>& nodes, const WallsAt<3>& at) {
  constexpr double aside = 0.5;  // of the way from the centroid to a corner
  const auto x = corners(nodes.x, cell);
  Vec<3> centroid = Vec<3>::Zero();
  for (int k = 0; k < 4; ++k) centroid += x(k) / 4;
  int inside = 0, last = -1;
  for (int n : cell) {
    const int w = nodes.tie[n].wall;
    auto on_wall = [&](int other) { return nodes.tie[other].wall == w; };
    if (w < 0 || w == last || std::all_of(cell.begin(), cell.end(), on_wall)) continue;
    last = w;
    auto is_solid = [&](const Vec<3>& point) {
      const double reach = at.walls[w].box().diagonal().norm();
      return at.walls[w].may_touch(at.poses[w], point, 0) &&
             at.walls[w].nearest(at.poses[w], point, reach).distance < 0;
    };
    inside += is_solid(centroid);
    for (int k = 0; k < 4; ++k) inside += is_solid(centroid + aside * (x(k) - centroid));
  }
  return inside == 0 ? 0.0 : volume<3>(x) * std::min(inside, 5) / 5;
}

// Whether it has nodes on two patches of a wall, off the edge between them.
bool spans_patches(const std::array<int, 4>& cell, const Nodes<3>& nodes) {
  for (int i = 1; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      if (joins_patches(nodes.tie[cell[i]], nodes.tie[cell[j]])) return true;
  return false;
}

// Gives facets back to walls that cells of the water pierce (pierced.hpp), as long as that leaves less of such cells in the
// solid. `decide`: what a cell holds. Those that still are wrong.
template <class Decide>
std::vector<int> recover_walls(Delaunay<3>& all, const Nodes<3>& nodes, const std::vector<char>& on_boundary,
                               const WallsAt<3>& at, const InsideTest<3>& inside, std::vector<Content>& content,
                               const Decide& decide) {
  using Cell = std::array<int, 4>;
  // A node of a wall, joined to one within the water or on another wall; most cells beyond the water have none.
  auto is_mixed = [&](const Cell& cell) {
    auto tied = [&](int n) { return nodes.tie[n].wall >= 0; };
    const auto on = std::ranges::find_if(cell, tied);
    return on != cell.end() && std::ranges::any_of(cell, [&](int n) {
             return !on_boundary[n] || (tied(n) && nodes.tie[n].wall != nodes.tie[*on].wall);
           });
  };
  // A node of a wall, joined to one of the free surface: through the air, or through the wall and water before it.
  auto spans_water = [&](const Cell& cell) {
    const auto x = corners(nodes.x, cell);
    const Vec<3> centroid = 0.25 * (x(0) + x(1) + x(2) + x(3));
    const int wall = std::ranges::max(cell, {}, [&](int n) { return nodes.tie[n].wall; });
    const int w = nodes.tie[wall].wall;
    if (w < 0 || std::ranges::none_of(cell, [&](int n) { return nodes.tie[n].wall < 0; })) return false;
    return std::ranges::any_of(cell, [&](int n) {
      if (nodes.tie[n].wall >= 0) return false;
      const Vec<3> point = 0.5 * (centroid + nodes.x[n]);
      return inside(point) && at.walls[w].nearest(at.poses[w], point, at.walls[w].diameter()).distance > 0;
    });
  };
  // A hole in the water, or water on both sides of an edge of a hull that is joined through it.
  auto is_wrong = [&](int c) {
    const Cell& cell = all.cells[c];
    if (!is_mixed(cell)) return content[c] == none && pierced(cell, nodes, at) > 0 && spans_water(cell);
    return (content[c] != water || spans_patches(cell, nodes)) && pierced(cell, nodes, at) > 0;
  };
  std::vector<char> wrong(all.cells.size());
  in_parallel(all.cells.size(), [&](std::size_t c) { wrong[c] = is_wrong(static_cast<int>(c)); });
  std::vector<int> piercing;
  for (std::size_t c = 0; c < wrong.size(); ++c)
    if (wrong[c]) piercing.push_back(static_cast<int>(c));
  constexpr double better = 0.999;  // each flip leaves less than that, so that they come to an end
  for (std::size_t next = 0; next < piercing.size(); ++next) {
    const int c = piercing[next];
    const Cell cell = all.cells[c];
    if (cell[0] < 0 || !is_wrong(c)) continue;
    Flip best;
    double least = better;
    auto consider = [&](Flip flip) {
      if (flip.fresh.empty()) return;
      double before = 0, after = 0;
      for (int k : flip.cells) before += pierced(all.cells[k], nodes, at);
      for (const Cell& f : flip.fresh) after += pierced(f, nodes, at);
      if (after < least * before) least = after / before, best = std::move(flip);
    };
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < k; ++j) consider(without_edge(all, nodes.x, c, cell[j], cell[k]));
      consider(without_facet(all, nodes.x, c, k));
    }
    if (best.fresh.empty()) continue;
    for (int k : best.cells) content[k] = none;
    const auto fresh = apply(best, all);
    content.resize(all.cells.size());
    for (int f : fresh) {
      content[f] = decide(all.cells[f]);
      piercing.push_back(f);
    }
  }
  std::erase_if(piercing, [&](int c) { return all.cells[c][0] < 0 || !is_wrong(c); });
  return piercing;
}

// Between nodes of two walls, and thinner than what is let pass for a facet on one of them.
template <int d>
bool is_pinched(const std::array<int, d + 1>& cell, double fullness, const Nodes<d>& nodes) {
  const int wall = nodes.tie[cell[0]].wall;
  auto tied = [&](int n) { return nodes.tie[n].wall >= 0; };
  auto on_another = [&](int n) { return nodes.tie[n].wall != wall; };
  return fullness < facet_meet && std::all_of(cell.begin(), cell.end(), tied) &&
         std::any_of(cell.begin(), cell.end(), on_another);
}

// Flat and thin cells with water all around are no gap in it: between them there would be a free surface within the water.
// Nor are thin ones between the water and walls: where walls meet, what is left of the gap between them is closed. On their
// own, closed in by walls, thin and pinched cells are no water: without a way out it would bear any pressure.
template <int d>
void fill_flat_cells(const Delaunay<d>& all, const Nodes<d>& nodes, const WallsAt<d>& at,
                     std::vector<Content>& content) {
  std::vector<int> thin;
  for (std::size_t c = 0; c < content.size(); ++c)
    if (content[c] != none && !is_filled(content[c])) thin.push_back(static_cast<int>(c));
  auto opens = [&](int c) {
    for (int k = 0; k <= d; ++k) {
      const int other = all.neighbours[c][k];
      if (other >= 0 && content[other] != none) continue;
      if (content[c] == flat_cell || wall_of(Facet<d>{facet_nodes(all.cells[c], k)}, nodes, at) < 0) return true;
    }
    return false;
  };
  auto is_part_of_water = [&](int c) {
    const auto& beside = all.neighbours[c];
    return (content[c] == pinched_water && opens(c)) ||
           std::any_of(beside.begin(), beside.end(), [&](int k) { return k >= 0 && is_filled(content[k]); });
  };
  // Takes what is `found` out of `thin`, and what is found with that.
  auto sort_out = [&](const auto& found, const auto& becomes) {
    for (std::size_t left = 0; left != thin.size();) {
      left = thin.size();
      std::erase_if(thin, [&](int c) {
        if (!found(c)) return false;
        content[c] = becomes(content[c]);
        return true;
      });
    }
  };
  sort_out([&](int c) { return content[c] != pinched_water && opens(c); }, [](Content) { return none; });
  sort_out(is_part_of_water, [](Content was) { return was == flat_cell ? enclosed_flat_cell : water; });
  for (int c : thin) content[c] = none;
}

// Water between nodes of one hull that nothing but that hull bounds is what chords leave in a hollow of it. No pressure is right in
// it: none has to be zero.
template <int d>
void leave_out_pockets(const Delaunay<d>& all, const Nodes<d>& nodes, const WallsAt<d>& at,
                       std::vector<Content>& content) {
  auto hull_of = [&](int c) {
    if (!is_filled(content[c])) return -1;  // nor has it the vertex at infinity for a corner
    const auto& cell = all.cells[c];
    const int wall = nodes.tie[cell[0]].wall;
    if (wall < 0 || at.walls[wall].encloses_fluid()) return -1;
    return std::ranges::all_of(cell, [&](int n) { return nodes.tie[n].wall == wall; }) ? wall : -1;
  };
  std::vector<char> seen(content.size(), 0);
  std::vector<int> pocket;
  for (std::size_t first = 0; first < content.size(); ++first) {
    const int hull = seen[first] ? -1 : hull_of(static_cast<int>(first));
    if (hull < 0) continue;
    pocket.assign(1, static_cast<int>(first));
    seen[first] = 1;
    bool is_closed = true;
    for (std::size_t i = 0; i < pocket.size(); ++i)
      for (int k = 0; k <= d; ++k) {
        const int c = pocket[i], other = all.neighbours[c][k];
        if (other < 0 || !is_filled(content[other]))
          is_closed = is_closed && wall_of(Facet<d>{facet_nodes(all.cells[c], k)}, nodes, at) >= 0;
        else if (hull_of(other) != hull)
          is_closed = false;
        else if (!seen[other])
          seen[other] = 1, pocket.push_back(other);
      }
    if (is_closed)
      for (int c : pocket) content[c] = none;
  }
}

}  // namespace

template <int d>
Recognised<d> recognise(Nodes<d>& nodes, const std::vector<Facet<d>>& old_boundary, const WallsAt<d>& walls,
                        const Alpha& limit) {
  return recognise<d>(delaunay<d>(nodes.x, old_boundary), nodes, old_boundary, walls, limit);
}

template <int d>
Recognised<d> recognise(Delaunay<d> all, Nodes<d>& nodes, const std::vector<Facet<d>>& old_boundary,
                        const WallsAt<d>& walls, const Alpha& limit, std::span<const Hub<d>> hubs) {
  const InsideTest<d> inside(nodes.x, old_boundary);
  const std::vector<char> on_boundary = nodes_of(old_boundary, nodes.size());
  Recognised<d> mesh;
  mesh.hub_in_water = reach_water(all, hubs, nodes, inside);
  if (mesh.hub_in_water) return mesh;

  const bool outline_decides = std::isinf(limit.never);
  auto decide = [&](const std::array<int, d + 1>& cell) -> Content {
    const Shape s = shape<d>(edge_matrix<d>(corners(nodes.x, cell)));
    if (s.degenerate || is_film<d>(cell, s.fullness, nodes, walls)) return flat_cell;
    double size = 0;
    bool has_inner = false;
    Vec<d> centroid = Vec<d>::Zero();
    for (int n : cell) {
      size += nodes.h[n] / (d + 1);
      centroid += nodes.x[n] / (d + 1);
      has_inner = has_inner || !on_boundary[n];
    }
    if (!has_inner && (d == 2 || (s.fullness < dust && !outline_decides)) &&
        volume<d>(corners(nodes.x, cell)) < dust * std::pow(size, d))
      return thin_cell;
    const double alpha = s.radius / size;
    if (alpha > limit.never) return inside(centroid) ? thin_cell : none;
    const bool is_water =
        ((has_inner && alpha < limit.inner) || inside(centroid) || (!has_inner && alpha < limit.join)) &&
        !in_solid<d>(cell, centroid, size, nodes, old_boundary, walls);
    if (!is_water) return none;
    return is_pinched<d>(cell, s.fullness, nodes) ? pinched_water : water;
  };
  std::vector<Content> content(all.cells.size());
  in_parallel(all.cells.size(), [&](std::size_t c) { content[c] = decide(all.cells[c]); });
  std::vector<int> piercing;
  if constexpr (d == 3) {
    piercing = recover_walls(all, nodes, on_boundary, walls, inside, content, decide);
    if (!outline_decides) std::erase_if(piercing, [&](int c) { return content[c] == water; });
  }
  fill_flat_cells(all, nodes, walls, content);
  leave_out_pockets(all, nodes, walls, content);

  mesh.cells.reserve(all.cells.size());
  nodes.spray.assign(nodes.size(), 1);
  nodes.surface.assign(nodes.size(), 0);
  for (std::size_t c = 0; c < all.cells.size(); ++c) {
    if (content[c] == enclosed_flat_cell) mesh.flat_cells.push_back(all.cells[c]);
    if (content[c] != water) continue;
    mesh.cells.push_back(all.cells[c]);
    for (int k = 0; k <= d; ++k) {
      nodes.spray[all.cells[c][k]] = 0;
      const int other = all.neighbours[c][k];
      if (other >= 0 && is_filled(content[other])) continue;
      mesh.boundary.push_back({facet_nodes(all.cells[c], k)});
    }
  }
  for (int c : piercing)
    for (int n : all.cells[c])
      if (!on_boundary[n] && nodes.tie[n].wall < 0) mesh.piercing.push_back(n);
  std::sort(mesh.piercing.begin(), mesh.piercing.end());
  mesh.piercing.erase(std::unique(mesh.piercing.begin(), mesh.piercing.end()), mesh.piercing.end());
  in_parallel(mesh.boundary.size(),
              [&](std::size_t f) { mesh.boundary[f].wall = wall_of(mesh.boundary[f], nodes, walls); });
  for (const auto& f : mesh.boundary)
    if (f.wall < 0)
      for (int n : f.nodes) nodes.surface[n] = 1;
  return mesh;
}

template Recognised<2> recognise(Nodes<2>&, const std::vector<Facet<2>>&, const WallsAt<2>&, const Alpha&);
template Recognised<3> recognise(Nodes<3>&, const std::vector<Facet<3>>&, const WallsAt<3>&, const Alpha&);

}  // namespace splashdown::fluid
