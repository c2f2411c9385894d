// In the plane: walls cut the regions exactly (polygon sets), and the outline is resampled to the size field.
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <cmath>

#include "fluid/initial/parts.hpp"

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
    for (auto& p : polygons(walls.walls[w].spec().surface, walls.poses[w])) {
      if (p.orientation() == CGAL::CLOCKWISE) {  // encloses the fluid, not the solid
        p.reverse_orientation();
        set.intersection(p);
      } else {
        set.difference(p);
      }
    }
  return set;
}

class Outliner {
 public:
  Outliner(const SizeField<2>& size, const WallsAt<2>& walls, InitialLiquid<2>& out)
      : size_(size), walls_(walls), out_(out) {}

  // Resamples a closed outline between its corners to the size field.
  void chain(const Polygon& polygon) {
    std::vector<Vec<2>> p;
    for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v)
      p.push_back({CGAL::to_double(v->x()), CGAL::to_double(v->y())});
    const std::size_t n = p.size();
    std::vector<WallTie> tie(n);
    for (std::size_t i = 0; i < n; ++i) tie[i] = tie_at<2>(p[i], walls_);
    auto edge_wall = [&](std::size_t i) { return tie_at<2>(0.5 * (p[i] + p[(i + 1) % n]), walls_).wall; };
    std::vector<int> wall(n);
    for (std::size_t i = 0; i < n; ++i) wall[i] = edge_wall(i);
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
      for (const Vec<2>& x : graded(path)) {
        const int w = wall[from];
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

  // Inner points of a path so that each piece holds the same integral of ds / h.
  std::vector<Vec<2>> graded(const std::vector<Vec<2>>& path) const {
    std::vector<Vec<2>> fine{path.front()};
    std::vector<double> count{0};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      Vec<2> x = path[i];
      const double length = (path[i + 1] - path[i]).norm();
      const Vec<2> along = (path[i + 1] - path[i]) / length;
      for (double s = 0; s < length;) {
        const double h = size_(x);
        const double ds = std::min(0.1 * h, length - s);
        s = length - s - ds < 1e-12 * length ? length : s + ds;
        x = path[i] + s * along;
        count.push_back(count.back() + ds / h);
        fine.push_back(x);
      }
    }
    const int pieces = std::max(1, static_cast<int>(std::lround(count.back())));
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
  const SizeField<2>& size_;
  const WallsAt<2>& walls_;
  InitialLiquid<2>& out_;
};

}  // namespace

template <>
void outline(const LiquidSpec<2>& liquid, const FluidSpec<2>& spec, const WallsAt<2>& walls, InitialLiquid<2>& out) {
  const std::vector<double> dry(walls.walls.size(), 0.0);
  const SizeField<2> size(spec.size, walls, dry, {}, {});
  Outliner outliner(size, walls, out);
  std::vector<CGAL::Polygon_with_holes_2<Epeck>> parts;
  clipped(liquid, walls).polygons_with_holes(std::back_inserter(parts));
  for (const auto& part : parts) {
    outliner.chain(part.outer_boundary());
    for (auto h = part.holes_begin(); h != part.holes_end(); ++h) outliner.chain(*h);
  }
}

}  // namespace splashdown::fluid
