#include "fluid/pfem/mesh/adapt/adapt.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>

#include "fluid/pfem/mesh/adapt/boundary_edges.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr double split_above = 1.5;
constexpr double coincide = 0.05;         // distance of nodes that are one, over h
constexpr double indistinct = 0.1;        // ... of a contact line at rest from a corner; nearer ones do not stay still
constexpr double crowd_below = 0.25;      // height of an inner node over a boundary facet, over h
constexpr double surely_fits = 1 + 1e-9;  // squares of lengths: what is nearer to a limit is looked at closely

double squared(double x) { return x * x; }

struct Edge {
  int a, b;
  double ratio;           // length over element size
  bool occupied = false;  // a node is in its middle
};

std::uint64_t key(int a, int b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

template <int d>
class Adapter {
 public:
  Adapter(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& walls, const RestingContact& rests)
      : nodes_(nodes),
        mesh_(mesh),
        walls_(walls),
        rests_(rests),
        edges_(mesh.boundary, nodes.size()),
        into_(nodes.size()) {
    std::iota(into_.begin(), into_.end(), 0);
  }

  AdaptReport<d> run() {
    collect();
    touched_.assign(nodes_.size(), 0);
    // Nodes that coincide first: no other merger may keep them apart.
    const auto apart = std::ranges::find_if(short_, [](const Edge& e) { return e.ratio >= coincide; });
    merge({short_.begin(), apart});
    uncrowd();
    merge({apart, short_.end()});
    renumber_boundary();
    edges_ = BoundaryEdges<d>(mesh_.boundary, nodes_.size());
    split();
    compact();
    return report_;
  }

 private:
  bool is_boundary_edge(int a, int b) const {
    bool found = false;
    edges_.around(mesh_.boundary, a, b, [&](int) { found = true; });
    return found;
  }

  // Each inner edge is met in several cells; only candidates are kept, duplicates fall to `touched_`. The order in
  // which threads find them is lost in sorting.
  void collect() {
    PerThread<std::pair<std::vector<Edge>, std::vector<Edge>>> found;
    in_pieces(mesh_.cells.size(), worthwhile, [&](std::size_t first, std::size_t last) {
      auto& [long_ones, short_ones] = found.local();
      for (std::size_t c = first; c < last; ++c) {
        const auto& cell = mesh_.cells[c];
        for (int i = 0; i < d; ++i)
          for (int j = i + 1; j <= d; ++j) {
            const int a = std::min(cell[i], cell[j]), b = std::max(cell[i], cell[j]);
            const double size = 0.5 * (nodes_.h[a] + nodes_.h[b]),
                         squared_length = (nodes_.x[a] - nodes_.x[b]).squaredNorm();
            if (surely_fits * squared_length < squared(split_above * size) &&
                squared_length > surely_fits * squared(merge_below * size))
              continue;
            const double ratio = std::sqrt(squared_length) / size;
            if (ratio > split_above) long_ones.push_back({a, b, ratio, has_node_beside(cell, a, b, coincide * size)});
            if (ratio < merge_below) short_ones.push_back({a, b, ratio});
          }
      }
    });
    for (const auto& [long_ones, short_ones] : found) {
      long_.insert(long_.end(), long_ones.begin(), long_ones.end());
      short_.insert(short_.end(), short_ones.begin(), short_ones.end());
    }
    auto order = [](const Edge& p, const Edge& q) {
      return p.ratio != q.ratio ? p.ratio < q.ratio : key(p.a, p.b) < key(q.a, q.b);
    };
    std::sort(short_.begin(), short_.end(), order);
    // The same edge in cells where its middle is free comes after one where it is not.
    std::sort(long_.begin(), long_.end(),
              [&](const Edge& p, const Edge& q) { return order(q, p) || (!order(p, q) && p.occupied && !q.occupied); });
  }

  bool has_node_beside(const std::array<int, d + 1>& cell, int a, int b, double reach) const {
    const Vec<d> middle = 0.5 * (nodes_.x[a] + nodes_.x[b]);
    return std::any_of(cell.begin(), cell.end(), [&](int n) {
      return n != a && n != b && (nodes_.x[n] - middle).squaredNorm() < squared(reach);
    });
  }

  void remove(int gone, int kept) {
    into_[gone] = kept;
    nodes_.bequeath(gone, kept);
    touched_[gone] = touched_[kept] = 1;
    ++report_.removed;
  }

  // An inner node close to a boundary facet makes a flat cell there, the harmful sliver of PFEM.
  void uncrowd() {
    using Corner = std::pair<std::size_t, int>;
    PerThread<std::vector<Corner>> found;
    in_parallel(mesh_.cells.size(), [&](std::size_t c) {
      if (const int inner = crowded_corner(mesh_.cells[c]); inner >= 0) found.local().emplace_back(c, inner);
    });
    std::vector<Corner> crowded;
    for (const auto& part : found) crowded.insert(crowded.end(), part.begin(), part.end());
    std::sort(crowded.begin(), crowded.end());
    for (const auto& [c, inner] : crowded) {
      const auto& cell = mesh_.cells[c];
      if (!touched_[cell[inner]]) remove(cell[inner], into_[cell[inner == 0 ? 1 : 0]]);
    }
  }
  // The corner of the cell that is too near to the facet opposite on the boundary, -1: none.
  int crowded_corner(const std::array<int, d + 1>& cell) const {
    int inner = -1, count = 0;
    for (int k = 0; k <= d; ++k)
      if (!edges_.on_boundary(cell[k])) inner = k, ++count;
    if (inner < 0 || count > 1) return -1;
    for (int i = 0; i <= d; ++i)
      for (int j = i + 1; j <= d; ++j)
        if (i != inner && j != inner && !is_boundary_edge(cell[i], cell[j])) return -1;
    const auto g = volume_gradients<d>(corners(nodes_.x, cell));
    const double height = volume<d>(corners(nodes_.x, cell)) / g.col(inner).norm();
    return height < crowd_below * nodes_.h[cell[inner]] ? inner : -1;
  }

  // What a node stands for. In 3D, lines carry as many nodes as their length asks for.
  enum Rank { within, boundary, contact_line, crease, separation_line, corner };
  Rank rank(int i) const {
    const WallTie& tie = nodes_.tie[i];
    if (tie.vertex >= 0) return corner;
    if (tie.crease >= 0) return nodes_.surface[i] ? separation_line : crease;
    if (tie.wall >= 0 && nodes_.surface[i]) return contact_line;
    return edges_.on_boundary(i) ? boundary : within;
  }
  bool may_merge_with_its_like(Rank rank, const Edge& e) const {
    if (!(nodes_.tie[e.a] == nodes_.tie[e.b]) || rank == corner) return false;
    if (rank <= boundary) return true;
    // In 2D a contact line is a point. Two that all but coincide are one.
    if (d == 2) return rank == contact_line && e.ratio < coincide;
    return rank != contact_line || is_contact_edge(e);
  }
  bool is_contact_edge(const Edge& e) const {
    bool wet = false, free = false;
    edges_.around(mesh_.boundary, e.a, e.b, [&](int f) { (mesh_.boundary[f].wall < 0 ? free : wet) = true; });
    return wet && free;
  }

  // From a contact line at rest to a corner or an edge of its wall, off the contact line.
  bool leads_off_resting_contact_line(const Edge& e, Rank rank_a, Rank rank_b) const {
    const Rank lower = std::min(rank_a, rank_b);
    if (rank_a == rank_b || (lower != contact_line && lower != separation_line)) return false;
    if (e.ratio < indistinct || is_contact_edge(e)) return false;
    return rests_(rank_a == lower ? e.a : e.b, (nodes_.x[e.a] - nodes_.x[e.b]).norm());
  }

  void merge(std::span<const Edge> edges) {
    for (const Edge& e : edges) {
      if (touched_[e.a] || touched_[e.b]) continue;
      const Rank rank_a = rank(e.a), rank_b = rank(e.b);
      const bool both_boundary = rank_a != within && rank_b != within;
      const WallTie &a = nodes_.tie[e.a], &b = nodes_.tie[e.b];
      const bool same_patch = d == 2 && a.wall >= 0 && a.wall == b.wall && a.patch == b.patch;
      if (both_boundary && !same_patch && !is_boundary_edge(e.a, e.b)) continue;           // across a thin jet
      if (a.wall >= 0 && b.wall >= 0 && a.wall != b.wall && !lies_in_mirror(e)) continue;  // across a gap between walls
      if (leads_off_resting_contact_line(e, rank_a, rank_b)) continue;
      if (rank_a == rank_b) {
        if (!may_merge_with_its_like(rank_a, e)) continue;
        nodes_.inherited[e.a] += nodes_.carried(e.a);
        nodes_.x[e.a] = 0.5 * (nodes_.x[e.a] + nodes_.x[e.b]);
        nodes_.v[e.a] = 0.5 * (nodes_.v[e.a] + nodes_.v[e.b]);
        nodes_.p[e.a] = 0.5 * (nodes_.p[e.a] + nodes_.p[e.b]);
        nodes_.compress_as(e.a, std::array{e.a, e.b});
        nodes_.inherited[e.a] -= nodes_.carried(e.a);
        attach(e.a);
        remove(e.b, e.a);
      } else if (rank_a > rank_b) {
        remove(e.b, e.a);
      } else {
        remove(e.a, e.b);
      }
    }
  }

  // Along a plane of symmetry, in which the side of the tank is none.
  int tank_in_mirror(const Edge& e) const {
    for (int n : {e.a, e.b})
      if (const WallTie& tie = nodes_.tie[n]; tie.wall >= 0 && walls_.walls[tie.wall].is_mirror(tie.patch))
        return tie.wall;
    return -1;
  }
  bool lies_in_mirror(const Edge& e) const {
    const int tank = tank_in_mirror(e);
    return tank >= 0 && lies_in(*walls_.walls[tank].spec().mirror, Facet<2>{{e.a, e.b}}, nodes_.x);
  }

  void renumber_boundary() {
    for (auto& f : mesh_.boundary)
      for (int& n : f.nodes) n = into_[n];
    std::erase_if(mesh_.boundary, [](const Facet<d>& f) {
      for (int a = 0; a < d; ++a)
        for (int b = a + 1; b < d; ++b)
          if (f.nodes[a] == f.nodes[b]) return true;
      return false;
    });
  }

  void attach(int i) {
    const int w = nodes_.tie[i].wall;
    if (w < 0) return;
    if (const int c = nodes_.tie[i].crease; c >= 0) {
      nodes_.x[i] = walls_.walls[w].nearest_on_crease(walls_.poses[w], nodes_.x[i], c);
      return;
    }
    const auto near = walls_.walls[w].nearest(walls_.poses[w], nodes_.x[i], walls_.walls[w].box().diagonal().norm());
    nodes_.x[i] = near.point;
    nodes_.tie[i].patch = near.patch;
  }

  void split() {
    for (const Edge& e : long_) {
      if (touched_[e.a] || touched_[e.b]) continue;
      touched_[e.a] = touched_[e.b] = 1;
      if (e.occupied) continue;
      const bool at_boundary = is_boundary_edge(e.a, e.b);
      WallTie tie;
      bool surface = false;
      if (at_boundary) tie = tie_between(e, surface);
      const int m =
          nodes_.add(0.5 * (nodes_.x[e.a] + nodes_.x[e.b]), 0.5 * (nodes_.v[e.a] + nodes_.v[e.b]),
                     0.5 * (nodes_.p[e.a] + nodes_.p[e.b]), tie, surface, 0.5 * (nodes_.h[e.a] + nodes_.h[e.b]));
      nodes_.compress_as(m, std::array{e.a, e.b});
      into_.push_back(m);
      attach(m);
      ++report_.inserted;
      if (at_boundary) edges_.split(mesh_.boundary, e.a, e.b, m);
    }
  }

  WallTie tie_between(const Edge& e, bool& surface) const {
    const WallTie &a = nodes_.tie[e.a], &b = nodes_.tie[e.b];
    WallTie tie;
    int only = -1, walls = 0;  // of the facets; a node where two walls meet is tied to one of them
    edges_.around(mesh_.boundary, e.a, e.b, [&](int f) {
      const int wall = mesh_.boundary[f].wall;
      if (wall < 0) surface = true;
      if (wall >= 0 && a.wall == wall && b.wall == wall) tie.wall = wall;
      if (walls == 0 || wall != only) only = wall, ++walls;
    });
    if (tie.wall < 0 && walls == 1 && a.wall >= 0 && b.wall >= 0) tie.wall = only;  // between nodes of two walls
    if (tie.wall < 0 && lies_in_mirror(e)) tie.wall = tank_in_mirror(e);
    if (tie.wall >= 0 && a.sharp() && b.sharp()) {
      constexpr double along = 0.1;  // distance of the edge's middle from a crease that it follows, over its length
      const Vec<d> middle = 0.5 * (nodes_.x[e.a] + nodes_.x[e.b]);
      const auto near = walls_.walls[tie.wall].nearest_crease(walls_.poses[tie.wall], middle, middle);
      if (near.crease >= 0 && near.distance < along * (nodes_.x[e.a] - nodes_.x[e.b]).norm()) tie.crease = near.crease;
    }
    return tie;
  }

  void compact() {
    if (report_.removed == 0) return;
    std::vector<char> merged(nodes_.size());
    for (std::size_t i = 0; i < merged.size(); ++i) merged[i] = into_[i] != static_cast<int>(i);
    discard(merged, nodes_, mesh_.boundary);
  }

  Nodes<d>& nodes_;
  Mesh<d>& mesh_;
  const WallsAt<d>& walls_;
  const RestingContact& rests_;
  BoundaryEdges<d> edges_;  // of the boundary as it is now
  std::vector<char> touched_;
  std::vector<int> into_;
  std::vector<Edge> long_, short_;
  AdaptReport<d> report_;
};

}  // namespace

template <int d>
AdaptReport<d> adapt(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& walls, const RestingContact& rests) {
  return Adapter<d>(nodes, mesh, walls, rests).run();
}

template <int d>
void keep(const std::vector<int>& kept, Nodes<d>& nodes, std::vector<Facet<d>>& boundary) {
  std::vector<int> renumber(nodes.size(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) renumber[kept[i]] = static_cast<int>(i);
  nodes.select(kept);
  for (auto& f : boundary)
    for (int& n : f.nodes) n = renumber[n];
}

template <int d>
bool discard(const std::vector<char>& marked, Nodes<d>& nodes, std::vector<Facet<d>>& boundary) {
  std::vector<int> kept;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (!marked[i]) kept.push_back(static_cast<int>(i));
  if (kept.size() == marked.size()) return false;
  keep(kept, nodes, boundary);
  return true;
}

template AdaptReport<2> adapt(Nodes<2>&, Mesh<2>&, const WallsAt<2>&, const RestingContact&);
template AdaptReport<3> adapt(Nodes<3>&, Mesh<3>&, const WallsAt<3>&, const RestingContact&);
template void keep(const std::vector<int>&, Nodes<2>&, std::vector<Facet<2>>&);
template void keep(const std::vector<int>&, Nodes<3>&, std::vector<Facet<3>>&);
template bool discard(const std::vector<char>&, Nodes<2>&, std::vector<Facet<2>>&);
template bool discard(const std::vector<char>&, Nodes<3>&, std::vector<Facet<3>>&);

}  // namespace splashdown::fluid
