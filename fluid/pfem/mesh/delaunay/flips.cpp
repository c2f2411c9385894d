#include "fluid/pfem/mesh/delaunay/flips.hpp"

namespace splashdown::fluid {
namespace {

using Cell = ClosedDelaunay<2>::Cell;

constexpr int ahead(int k) { return (k + 1) % 3; }  // counter-clockwise
constexpr int behind(int k) { return (k + 2) % 3; }

int corner_of(int point, const Cell& cell) {
  return static_cast<int>(std::find(cell.begin(), cell.end(), point) - cell.begin());
}

// A cell around each point, -1 where there is none.
std::vector<int> cells_around(const ClosedDelaunay<2>& mesh, std::size_t points) {
  std::vector<int> of(points + ClosedDelaunay<2>::far + 1, -1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int n : mesh.cells[c]) of[n] = static_cast<int>(c);
  return of;
}

// Cells around a point, counter-clockwise, until `visit(cell, corner)` says so: whether it did.
template <class Visit>
bool around(int point, int start, const ClosedDelaunay<2>& mesh, Visit visit) {
  int c = start;
  do {
    const int k = corner_of(point, mesh.cells[c]);
    if (visit(c, k)) return true;
    c = mesh.neighbours[c][ahead(k)];
  } while (c != start);
  return false;
}

}  // namespace

bool has_edges(const ClosedDelaunay<2>& mesh, std::size_t points, const std::vector<Facet<2>>& facets) {
  const std::vector<int> of = cells_around(mesh, points);
  return std::all_of(facets.begin(), facets.end(), [&](const Facet<2>& f) {
    const auto [a, b] = f.nodes;
    return a == b || of[a] < 0 || of[b] < 0 ||
           around(a, of[a], mesh, [&, b = b](int c, int k) { return mesh.cells[c][ahead(k)] == b; });
  });
}

// ---- Delaunay

std::vector<int> Flips::make_delaunay(std::vector<FacetAt> edges) {
  std::vector<int> changed;
  while (!edges.empty()) {
    const FacetAt edge = edges.back();
    edges.pop_back();
    if (!flips(edge)) continue;
    flip(edge);
    edges.insert(edges.end(), flipped_.begin(), flipped_.end());
    for (const FacetAt& f : flipped_) changed.push_back(f.cell);
  }
  return changed;
}

bool Flips::flips(const FacetAt& edge) const {
  const auto& mesh = cells_.mesh;
  const FacetAt other = cells_.beyond(edge);
  const Cell &cell = mesh.cells[edge.cell], &beyond = mesh.cells[other.cell];
  if (MovedCells<2>::lost_a_corner(cell) || MovedCells<2>::lost_a_corner(beyond) || !cells_.finite(cell) ||
      !cells_.finite(beyond) || is_kept(cell[ahead(edge.corner)], cell[behind(edge.corner)]) ||
      !cells_.positive(cell) || !cells_.positive(beyond) || cells_.locally_delaunay(edge))
    return false;
  // Where cells lie upon each other a corner of the edge may have but three of them: flipped, two would share two edges.
  const Cell &n = mesh.neighbours[edge.cell], &m = mesh.neighbours[other.cell];
  return n[ahead(edge.corner)] != m[behind(other.corner)] && n[behind(edge.corner)] != m[ahead(other.corner)];
}

// Cells a p q and b q p become a p b and b q a.
void Flips::flip(const FacetAt& edge) {
  auto& mesh = cells_.mesh;
  const FacetAt other = cells_.beyond(edge);
  const int c = edge.cell, o = other.cell, k = edge.corner, l = other.corner;
  const int a = mesh.cells[c][k], p = mesh.cells[c][ahead(k)], q = mesh.cells[c][behind(k)], b = mesh.cells[o][l];
  const int qa = mesh.neighbours[c][ahead(k)], ap = mesh.neighbours[c][behind(k)];
  const int pb = mesh.neighbours[o][ahead(l)], bq = mesh.neighbours[o][behind(l)];
  mesh.cells[c] = {a, p, b};
  mesh.neighbours[c] = {pb, o, ap};
  mesh.cells[o] = {b, q, a};
  mesh.neighbours[o] = {qa, c, bq};
  std::replace(mesh.neighbours[pb].begin(), mesh.neighbours[pb].end(), o, c);
  std::replace(mesh.neighbours[qa].begin(), mesh.neighbours[qa].end(), c, o);
  flipped_ = {{c, 0}, {c, 2}, {o, 0}, {o, 2}};
  if (cell_of_.empty()) return;
  for (int n : {a, p, b}) cell_of_[n] = c;
  cell_of_[q] = o;
}

// ---- edges that are to be kept

void Flips::keep(const std::vector<Facet<2>>& facets) {
  cell_of_ = cells_around(cells_.mesh, cells_.at.size() - ClosedDelaunay<2>::far);
  for (const Facet<2>& f : facets) {
    auto [from, to] = f.nodes;
    if (from == to || cell_of_[from] < 0 || cell_of_[to] < 0) continue;
    while (from != to) {
      const auto reached = make_edge(from, to);
      if (!reached) break;
      from = *reached;
    }
  }
}

// The edge from a node towards another: to that one, or to the first node on the way. None if a kept one is crossed.
std::optional<int> Flips::make_edge(int from, int to) {
  std::vector<FacetAt> crossed, touched;
  int end = crossed_by(from, to, crossed);
  // Each flip takes a crossing away, or an edge of the node whose edges it takes.
  for (std::size_t left = (crossed.size() + 1) * (crossed.size() + 1); left > 0 && end >= 0 && !crossed.empty();
       --left) {
    const auto edge = next_flip(from, end, crossed);
    if (!edge) break;
    flip(*edge);
    touched.insert(touched.end(), flipped_.begin(), flipped_.end());
    end = crossed_by(from, end, crossed);
  }
  const bool made = end >= 0 && crossed.empty();
  if (made) kept_.insert(key(from, end));
  make_delaunay(std::move(touched));
  return made ? std::optional(end) : std::nullopt;
}

// The edge that a segment leaves the cells around its first node through, or else the node on it that it comes to: that node,
// or -1.
int Flips::first_crossed(int from, int to, std::vector<FacetAt>& crossed) const {
  const auto& mesh = cells_.mesh;
  int reached = -1;
  around(from, cell_of_[from], mesh, [&](int c, int k) {
    const int p = mesh.cells[c][ahead(k)], q = mesh.cells[c][behind(k)];
    if (p == to) return reached = p, true;
    const auto side_p = side(from, to, p);
    if (side_p == CGAL::POSITIVE) return false;
    if (side_p == CGAL::ZERO) {
      const auto &x = cells_.at[from], &y = cells_.at[to], &z = cells_.at[p];
      if ((y - x) * (z - x) > 0) return reached = p, true;
      return false;
    }
    if (side(from, to, q) != CGAL::POSITIVE) return false;
    crossed.push_back({c, k});
    return true;
  });
  return reached;
}

// Edges that the segment crosses, in their order, up to the first node on it: that node. -1 if one of them is kept.
int Flips::crossed_by(int from, int to, std::vector<FacetAt>& crossed) const {
  const auto& mesh = cells_.mesh;
  crossed.clear();
  if (const int reached = first_crossed(from, to, crossed); reached >= 0) return reached;
  while (!crossed.empty()) {
    const FacetAt edge = crossed.back();
    const Cell& cell = mesh.cells[edge.cell];
    if (is_kept(cell[ahead(edge.corner)], cell[behind(edge.corner)])) break;
    const FacetAt other = cells_.beyond(edge);
    const int next = mesh.cells[other.cell][other.corner];
    if (next == to) return to;
    const auto on = side(from, to, next);
    if (on == CGAL::ZERO) return next;
    // Corners of `other`: next, then the one on the left, then the one on the right.
    const int left = ahead(other.corner), right = behind(other.corner);
    crossed.push_back({other.cell, on == CGAL::POSITIVE ? left : right});
  }
  return -1;
}

bool Flips::convex(const FacetAt& edge) const {
  const auto& mesh = cells_.mesh;
  const FacetAt other = cells_.beyond(edge);
  const Cell& cell = mesh.cells[edge.cell];
  const int a = cell[edge.corner], p = cell[ahead(edge.corner)], q = cell[behind(edge.corner)];
  const int b = mesh.cells[other.cell][other.corner];
  return side(a, p, b) == CGAL::POSITIVE && side(b, q, a) == CGAL::POSITIVE;
}

// The node on the left that is farthest from the segment is a convex corner of what is crossed, and so is one of those on the
// right that its crossed edges lead to.
std::optional<FacetAt> Flips::next_flip(int from, int to, const std::vector<FacetAt>& crossed) const {
  const auto along = cells_.at[to] - cells_.at[from];
  auto left_of = [&](const FacetAt& edge) { return cells_.mesh.cells[edge.cell][behind(edge.corner)]; };
  auto distance = [&](const FacetAt& edge) {
    const auto x = cells_.at[left_of(edge)] - cells_.at[from];
    return along.x() * x.y() - along.y() * x.x();
  };
  const int farthest = left_of(*std::max_element(
      crossed.begin(), crossed.end(), [&](const FacetAt& a, const FacetAt& b) { return distance(a) < distance(b); }));
  const auto found = std::find_if(crossed.begin(), crossed.end(),
                                  [&](const FacetAt& edge) { return left_of(edge) == farthest && convex(edge); });
  return found != crossed.end() ? std::optional(*found) : std::nullopt;
}

}  // namespace splashdown::fluid
