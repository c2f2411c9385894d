// In the plane: walls cut the regions exactly (polygon sets), and the outline is resampled to the size field.
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <algorithm>
#include <cmath>

#include "fluid/pfem/initial/parts.hpp"

namespace splashdown::fluid {
namespace {

using CGAL::Epeck;
using Polygon = CGAL::Polygon_2<Epeck>;
using PolygonSet = CGAL::Polygon_set_2<Epeck>;

// Chains of a surface's facets as polygons; a tank's outline runs clockwise and is turned.
std::vector<Polygon> polygons(const Surface<2>& s, const Isometry<2>& pose) {
  std::vector<int> next(s.vertices.cols(), -1);
  for (int f = 0; f < s.facets.cols(); ++f) next[s.facets(0, f)] = s.facets(1, f);
  std::vector<char> seen(next.size(), 0);
  std::vector<Polygon> out;
  for (std::size_t first = 0; first < next.size(); ++first) {
    if (seen[first] || next[first] < 0) continue;
    Polygon p;
    for (int v = static_cast<int>(first); !seen[v]; v = next[v]) {
      seen[v] = 1;
      const Vec<2> x = pose * Vec<2>(s.vertices.col(v));
      p.push_back({x.x(), x.y()});
    }
    out.push_back(std::move(p));
  }
  return out;
}

PolygonSet clipped(const LiquidSpec<2>& liquid, const WallsAt<2>& walls) {
  PolygonSet set;
  for (auto& p : polygons(liquid.boundary, Isometry<2>::Identity())) {
    if (p.orientation() == CGAL::CLOCKWISE) p.reverse_orientation();
    set.insert(p);
  }
  for (std::size_t w = 0; w < walls.walls.size(); ++w)
    for (auto& p : polygons(walls.walls[w].spec().surface, walls.poses[w].pose())) {
      if (p.orientation() == CGAL::CLOCKWISE) {  // encloses the fluid, not the solid
        p.reverse_orientation();
        set.intersection(p);
      } else {
        set.difference(p);
      }
    }
  return set;
}

// A closed outline: its points, what they are tied to, and the wall that the edge from each to the next lies on.
struct Ring {
  std::vector<Vec<2>> x;
  std::vector<WallTie> tie;
  std::vector<int> wall;  // -1: free surface
};

Ring ring_of(const Polygon& polygon, const WallsAt<2>& walls) {
  Ring ring;
  for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v)
    ring.x.push_back({CGAL::to_double(v->x()), CGAL::to_double(v->y())});
  const std::size_t n = ring.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    ring.tie.push_back(tie_at<2>(ring.x[i], walls));
    ring.wall.push_back(tie_at<2>(0.5 * (ring.x[i] + ring.x[(i + 1) % n]), walls).wall);
  }
  return ring;
}

// Some point of a path lies beside the line between its ends.
bool is_curved(const std::vector<Vec<2>>& path) {
  constexpr double roundoff = 1e-9;  // of its length
  const Vec<2> chord = path.back() - path.front();
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return std::ranges::any_of(path, [&](const Vec<2>& x) {
    const Vec<2> from = x - path.front();
    return std::abs(chord.x() * from.y() - chord.y() * from.x()) > roundoff * length * chord.norm() ||
           from.norm() > (1 + roundoff) * chord.norm();
  });
}

class Outliner {
 public:
  // `at_surface`: `size` with the free surface as a source. Straight lines need no points of it: the mesh is refined along them.
  Outliner(const SizeField<2>& size, const SizeField<2>& at_surface, const WallsAt<2>& walls, InitialLiquid<2>& out)
      : size_(size), at_surface_(at_surface), walls_(walls), out_(out) {}

  // Resamples a closed outline between its corners to the size field.
  void chain(const Ring& ring) {
    const auto& [p, tie, wall] = ring;
    const std::size_t n = p.size();
    std::vector<std::size_t> corner;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec<2> before = (p[i] - p[(i + n - 1) % n]).normalized(), after = (p[(i + 1) % n] - p[i]).normalized();
      const bool sharp = before.dot(after) < least_smooth_cosine;
      if (sharp || tie[i].vertex >= 0 || wall[i] != wall[(i + n - 1) % n]) corner.push_back(i);
    }
    if (corner.empty()) corner.push_back(0);
    const int first = static_cast<int>(out_.nodes.size());
    std::vector<int> ring_wall;
    for (std::size_t c = 0; c < corner.size(); ++c) {
      const std::size_t from = corner[c], to = c + 1 < corner.size() ? corner[c + 1] : corner[0] + n;
      std::vector<Vec<2>> path;
      for (std::size_t i = from; i <= to; ++i) path.push_back(p[i % n]);
      add_corner(p[from], tie[from]);
      ring_wall.push_back(wall[from]);
      const int w = wall[from];
      for (const Vec<2>& x : graded(path, w < 0 && is_curved(path) ? at_surface_ : size_)) {
        Vec<2> at = x;
        WallTie on;
        if (w >= 0) {
          const auto near = walls_.walls[w].nearest(walls_.poses[w], x, walls_.walls[w].box().diagonal().norm());
          at = near.point;
          on = {w, near.patch, -1};
        }
        out_.nodes.add(at, Vec<2>::Zero(), 0, on, w < 0);
        ring_wall.push_back(w);
      }
    }
    const int count = static_cast<int>(ring_wall.size());
    for (int i = 0; i < count; ++i) out_.mesh.boundary.push_back({{first + i, first + (i + 1) % count}, ring_wall[i]});
  }

  void add_corner(const Vec<2>& x, WallTie tie) { out_.nodes.add(x, Vec<2>::Zero(), 0, tie, false); }

  // Inner points of a path so that each piece holds the same integral of ds / h. A closed one encloses something.
  static std::vector<Vec<2>> graded(const std::vector<Vec<2>>& path, const SizeField<2>& size) {
    std::vector<Vec<2>> fine{path.front()};
    std::vector<double> count{0};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      Vec<2> x = path[i];
      const double length = (path[i + 1] - path[i]).norm();
      const Vec<2> along = (path[i + 1] - path[i]) / length;
      for (double s = 0; s < length;) {
        const double h = size(x);
        const double ds = std::min(0.1 * h, length - s);
        s = length - s - ds < 1e-12 * length ? length : s + ds;
        x = path[i] + s * along;
        count.push_back(count.back() + ds / h);
        fine.push_back(x);
      }
    }
    const bool is_closed = path.front() == path.back();
    const int pieces = std::max(is_closed ? 3 : 1, static_cast<int>(std::lround(count.back())));
    std::vector<Vec<2>> out;
    std::size_t k = 0;
    for (int i = 1; i < pieces; ++i) {
      const double target = count.back() * i / pieces;
      while (count[k + 1] < target) ++k;
      const double t = (target - count[k]) / (count[k + 1] - count[k]);
      out.push_back(fine[k] + t * (fine[k + 1] - fine[k]));
    }
    return out;
  }

 private:
  const SizeField<2>&size_, &at_surface_;
  const WallsAt<2>& walls_;
  InitialLiquid<2>& out_;
};

SizeField<2> size_field(const FluidSpec<2>& spec, const std::vector<Ring>& rings, const WallsAt<2>& walls) {
  std::vector<Vec<2>> x;
  Mesh<2> mesh;
  for (const Ring& ring : rings) {
    const int first = static_cast<int>(x.size()), n = static_cast<int>(ring.x.size());
    x.insert(x.end(), ring.x.begin(), ring.x.end());
    for (int i = 0; i < n; ++i)
      mesh.boundary.push_back({{first + i, first + (i + 1) % n}, ring.wall[static_cast<std::size_t>(i)]});
  }
  return SizeField<2>(spec.size, walls, std::vector<double>(walls.walls.size(), 0.0), x, mesh);
}

}  // namespace

template <>
OutlineSketch sketch(const LiquidSpec<2>& liquid, const FluidSpec<2>&, const WallsAt<2>& walls) {
  return {.is_empty = clipped(liquid, walls).is_empty()};
}

template <>
void outline(const LiquidSpec<2>& liquid, const FluidSpec<2>& spec, const WallsAt<2>& walls, InitialLiquid<2>& out) {
  std::vector<CGAL::Polygon_with_holes_2<Epeck>> parts;
  clipped(liquid, walls).polygons_with_holes(std::back_inserter(parts));
  std::vector<Ring> rings;
  for (const auto& part : parts) {
    rings.push_back(ring_of(part.outer_boundary(), walls));
    for (auto h = part.holes_begin(); h != part.holes_end(); ++h) rings.push_back(ring_of(*h, walls));
  }
  const SizeField<2> size = size_field(spec, {}, walls), at_surface = size_field(spec, rings, walls);
  Outliner outliner(size, at_surface, walls, out);
  for (const Ring& ring : rings) outliner.chain(ring);
}

}  // namespace splashdown::fluid
