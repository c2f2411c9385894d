#include "fluid/ale/mesh/moved_mesh.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "fluid/ale/mesh/mesh_quality.hpp"

namespace splashdown::ale {
namespace {

/// Where an arc length from cut to cut ends, the last cut being followed by the first.
double next_cut(const HullLine& line, std::size_t k) {
  const auto& cuts = line.cuts();
  return k + 1 < cuts.size() ? cuts[k + 1] : line.length() + cuts[0];
}

/// The wall that arc lengths from each cut to the next one lie on.
std::vector<int> walls_of_edges(const HullLine& line) {
  std::vector<int> walls;
  for (std::size_t k = 0; k < line.cuts().size(); ++k)
    walls.push_back(line.wall_at(0.5 * (line.cuts()[k] + next_cut(line, k))));
  return walls;
}

/// Where the cuts are now. Walls share a node as they do in a mesh: it belongs to the first of them.
Nodes cuts_now(const HullLine& line, const PlaceOnWalls& place) {
  const std::size_t count = line.cuts().size();
  const auto of_edges = walls_of_edges(line);
  std::vector<int> walls;
  Nodes at_start(2, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    walls.push_back(std::min(of_edges[k], of_edges[(k + count - 1) % count]));
    at_start.col(static_cast<Eigen::Index>(k)) = line.at(line.cuts()[k]);
  }
  return place(walls, at_start);
}

/// Edges halved where their middles are farther from their chords now, over the chord. False: none is.
bool halve_bent_edges(HullLine& line, double bent, const PlaceOnWalls& place) {
  HullLine halves = line;
  std::vector<double> cuts;
  for (std::size_t k = 0; k < line.cuts().size(); ++k) {
    cuts.push_back(line.cuts()[k]);
    cuts.push_back(0.5 * (line.cuts()[k] + next_cut(line, k)));
  }
  halves.cut_at(cuts);
  const Nodes now = cuts_now(halves, place);
  std::vector<double> kept;
  for (Eigen::Index k = 0; k < now.cols(); k += 2) {
    kept.push_back(cuts[static_cast<std::size_t>(k)]);
    const Vec<2> from = now.col(k), middle = now.col(k + 1), to = now.col((k + 2) % now.cols());
    if ((middle - 0.5 * (from + to)).norm() > bent * (to - from).norm())
      kept.push_back(cuts[static_cast<std::size_t>(k + 1)]);
  }
  const bool is_new = kept.size() > line.cuts().size();
  line.cut_at(std::move(kept));
  return is_new;
}

/// The polygon through the cuts of an outline, where they are now, divided at its corners.
HullLine polygon_now(const HullLine& line, const PlaceOnWalls& place) {
  std::vector<Vec<2>> points;
  const Nodes now = cuts_now(line, place);
  for (const auto& x : now.colwise()) points.emplace_back(x);
  HullLine polygon(std::move(points), walls_of_edges(line));
  polygon.cut_at_points();
  return polygon;
}

/// The edge of the division that an arc length lies on.
std::size_t edge_of(const HullLine& line, double arc) {
  const auto next = std::ranges::upper_bound(line.cuts(), arc);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - line.cuts().begin(), 1) - 1);
}

/// The arc length at t = 0 of one on the polygon of its cuts.
double arc_at_start(const HullLine& first, const HullLine& polygon, double arc) {
  const std::size_t k = edge_of(polygon, arc);
  const double share = (arc - polygon.cuts()[k]) / (next_cut(polygon, k) - polygon.cuts()[k]);
  return first.cuts()[k] + share * (next_cut(first, k) - first.cuts()[k]);
}

/// A mesh around outlines that are divided so, `now` where they are.
MovedMesh mesh_around(const MeshSpec& spec, const std::vector<HullLine>& first, const std::vector<HullLine>& now,
                      const PlaceOnWalls& place) {
  MovedMesh made{.mesh = flow_mesh(spec, now), .at_start = {}};
  auto& mesh = made.mesh;
  made.at_start = mesh.nodes;
  std::vector<int> wall_of(static_cast<std::size_t>(mesh.size()), -1);
  for (const auto& edge : mesh.boundary)
    for (std::size_t k = 0; k < 3 && edge.wall >= 0; ++k) {
      const auto line = static_cast<std::size_t>(edge.line);
      const int node = edge.nodes[k];
      auto& wall = wall_of[static_cast<std::size_t>(node)];
      if (wall < 0 || edge.wall < wall) wall = edge.wall;
      made.at_start.col(node) = first[line].at(arc_at_start(first[line], now[line], edge.arcs[k]));
    }
  std::vector<int> nodes, walls;
  for (int a = 0; a < mesh.size(); ++a)
    if (const int wall = wall_of[static_cast<std::size_t>(a)]; wall >= 0) {
      nodes.push_back(a);
      walls.push_back(wall);
    }
  mesh.nodes(Eigen::all, nodes) = place(walls, made.at_start(Eigen::all, nodes));
  return made;
}

/// Halves the edges of outlines at whose nodes cells are less even. False: there are none.
bool halve_at_uneven_cells(const FlowMesh& mesh, double even, const std::vector<HullLine>& now,
                           std::vector<HullLine>& first) {
  const auto evennesses = evenness(mesh);
  std::vector<char> is_uneven(static_cast<std::size_t>(mesh.size()), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int a : mesh.cells[c])
      if (evennesses[c] < even) is_uneven[static_cast<std::size_t>(a)] = 1;
  std::vector<std::set<std::size_t>> halved(first.size());
  for (const auto& edge : mesh.boundary)
    if (edge.wall >= 0 &&
        std::ranges::any_of(edge.nodes, [&](int a) { return is_uneven[static_cast<std::size_t>(a)]; })) {
      const auto line = static_cast<std::size_t>(edge.line);
      halved[line].insert(edge_of(now[line], edge.arcs[2]));
    }
  for (std::size_t l = 0; l < first.size(); ++l) {
    auto cuts = first[l].cuts();
    for (const std::size_t k : halved[l]) cuts.push_back(0.5 * (first[l].cuts()[k] + next_cut(first[l], k)));
    std::ranges::sort(cuts);
    first[l].cut_at(std::move(cuts));
  }
  return std::ranges::any_of(halved, [](const auto& edges) { return !edges.empty(); });
}

}  // namespace

MovedMesh moved_mesh(const MeshSpec& spec, std::vector<HullLine> first, const PlaceOnWalls& place) {
  constexpr int most_halvings = 3, most_tries = 6;
  constexpr double bent = 0.125, even = 0.25;
  for (auto& line : first)
    for (int k = 0; k < most_halvings && halve_bent_edges(line, bent, place); ++k) continue;
  for (int k = 0; k < most_tries; ++k) {
    std::vector<HullLine> now;
    for (const auto& line : first) now.push_back(polygon_now(line, place));
    auto made = mesh_around(spec, first, now, place);
    if (!halve_at_uneven_cells(made.mesh, even, now, first)) return made;
  }
  throw std::invalid_argument("ale fluid: the outline of a body is too curved for its elements");
}

}  // namespace splashdown::ale
