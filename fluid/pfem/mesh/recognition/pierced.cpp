#include "fluid/pfem/mesh/recognition/pierced.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splashdown::fluid {
namespace {

using Cell = std::array<int, 4>;
constexpr int gone = -1;
constexpr double flat = 1e-6;            // smallest cell over all: below it the new ones are no better than the old
constexpr std::size_t largest_ring = 7;  // mean of a Delaunay triangulation: 5.2 cells around an edge

int corner_of(const Cell& cell, int node) {
  return static_cast<int>(std::find(cell.begin(), cell.end(), node) - cell.begin());
}

/// Cells around an edge and the nodes between them: cell i holds nodes i and i + 1.
struct Ring {
  std::vector<int> cells, nodes;
};

Ring ring_around(const Delaunay<3>& mesh, int start, int a, int b) {
  Ring ring;
  const Cell& first = mesh.cells[start];
  std::array<int, 2> others{};
  int count = 0;
  for (int n : first)
    if (n != a && n != b) others[count++] = n;
  int behind = others[0], ahead = others[1];
  for (int cell = start; ring.cells.size() <= largest_ring;) {
    ring.cells.push_back(cell);
    ring.nodes.push_back(behind);
    cell = mesh.neighbours[cell][corner_of(mesh.cells[cell], behind)];
    if (cell < 0) return {};
    if (cell == start) return ring;
    behind = ahead;
    for (int n : mesh.cells[cell])
      if (n != a && n != b && n != behind) ahead = n;
  }
  return {};
}

/// Cells of the fan from node `apex` of the ring.
std::vector<Cell> fan(const Ring& ring, std::size_t apex, int a, int b) {
  const std::size_t m = ring.nodes.size();
  auto at = [&](std::size_t i) { return ring.nodes[(apex + i) % m]; };
  std::vector<Cell> cells;
  for (std::size_t i = 1; i + 1 < m; ++i) {
    cells.push_back({at(0), at(i), at(i + 1), a});
    cells.push_back({at(0), at(i + 1), at(i), b});
  }
  return cells;
}

/// Volume of the smallest cell over all of them; negative if one is turned over.
double least_share(std::span<const Vec<3>> x, const std::vector<Cell>& cells) {
  double least = std::numeric_limits<double>::max(), sum = 0;
  for (const Cell& cell : cells) {
    const double of_cell = volume<3>(corners(x, cell));
    least = std::min(least, of_cell);
    sum += std::abs(of_cell);
  }
  return least / sum;
}

std::array<int, 3> sorted_facet(const Cell& cell, int k) {
  auto nodes = facet_nodes(cell, k);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

Flip without_edge(const Delaunay<3>& mesh, std::span<const Vec<3>> x, int cell, int a, int b) {
  const Ring ring = ring_around(mesh, cell, a, b);
  const std::size_t m = ring.nodes.size();
  Flip flip{ring.cells, {}};
  if (m < 3) return flip;
  double fullest = flat;
  for (std::size_t apex = 0; apex < m; ++apex)
    for (const auto& cells : {fan(ring, apex, a, b), fan(ring, apex, b, a)})
      if (const double share = least_share(x, cells); share > fullest) fullest = share, flip.fresh = cells;
  return flip;
}

Flip without_facet(const Delaunay<3>& mesh, std::span<const Vec<3>> x, int cell, int corner) {
  const int other = mesh.neighbours[cell][corner];
  if (other < 0) return {};
  const auto facet = facet_nodes(mesh.cells[cell], corner);
  int beyond = -1;
  for (int n : mesh.cells[other])
    if (std::find(facet.begin(), facet.end(), n) == facet.end()) beyond = n;
  Flip flip{{cell, other}, {}};
  for (int k = 0; k < 3; ++k) flip.fresh.push_back({facet[(k + 1) % 3], facet[k], beyond, mesh.cells[cell][corner]});
  if (least_share(x, flip.fresh) <= flat) flip.fresh.clear();
  return flip;
}

std::vector<int> apply(const Flip& flip, Delaunay<3>& mesh) {
  // The facets of the rim, and of the new cells, meet in pairs.
  struct Side {
    std::array<int, 3> facet;
    int cell, corner;
  };
  std::vector<Side> sides;
  for (int c : flip.cells)
    for (int k = 0; k < 4; ++k) {
      const int beyond = mesh.neighbours[c][k];
      if (std::find(flip.cells.begin(), flip.cells.end(), beyond) != flip.cells.end()) continue;
      const auto facet = sorted_facet(mesh.cells[c], k);
      int back = -1;
      for (int j = 0; beyond >= 0 && j < 4; ++j)
        if (mesh.neighbours[beyond][j] == c && sorted_facet(mesh.cells[beyond], j) == facet) back = j;
      sides.push_back({facet, beyond, back});
    }
  std::vector<int> changed = flip.cells;
  while (changed.size() < flip.fresh.size()) {
    changed.push_back(static_cast<int>(mesh.cells.size()));
    mesh.cells.emplace_back();
    mesh.neighbours.emplace_back();
  }
  for (std::size_t i = flip.fresh.size(); i < changed.size(); ++i) {
    mesh.cells[changed[i]].fill(gone);
    mesh.neighbours[changed[i]].fill(gone);
  }
  changed.resize(flip.fresh.size());
  for (std::size_t i = 0; i < flip.fresh.size(); ++i) {
    mesh.cells[changed[i]] = flip.fresh[i];
    for (int k = 0; k < 4; ++k) sides.push_back({sorted_facet(flip.fresh[i], k), changed[i], k});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) { return p.facet < q.facet; });
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Side &p = sides[i], &q = sides[i + 1];
    if (p.cell >= 0) mesh.neighbours[p.cell][p.corner] = q.cell;
    if (q.cell >= 0) mesh.neighbours[q.cell][q.corner] = p.cell;
  }
  return changed;
}

}  // namespace splashdown::fluid
