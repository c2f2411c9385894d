#include "fluid/initial.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fluid/adapt.hpp"
#include "fluid/contact.hpp"
#include "fluid/size_field.hpp"

namespace splashdown::fluid {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonSet = CGAL::Polygon_set_2<Kernel>;

constexpr double on_wall = 1e-9;      // over the wall's size: roundoff of the clipping
// While nodes are still few, cells are large for their size field and only the outline tells what is fluid.
constexpr Alpha outline_decides{std::numeric_limits<double>::infinity(), 0.0, 0.0};
constexpr int smoothing_sweeps = 30;  // until the node spacing no longer changes visibly

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

class Filler {
 public:
  Filler(const FluidSpec<2>& spec, const WallsAt<2>& walls)
      : spec_(spec), walls_(walls), wetted_(walls.walls.size(), 0.0), size_(spec.size, walls, wetted_, {}, {}) {}

  InitialLiquid<2> run() {
    for (const auto& liquid : spec_.liquids) outline(liquid);
    if (out_.nodes.size() == 0)
      throw std::invalid_argument("no liquid: every region lies outside the tank or inside a body");
    refine();
    for (std::size_t i = 0; i < out_.nodes.size(); ++i) out_.nodes.v[i] = velocity(out_.nodes.x[i]);
    return std::move(out_);
  }

 private:
  Vec<2> velocity(const Vec<2>& x) const {
    for (std::size_t k = 0; k < spec_.liquids.size(); ++k)
      if (spec_.liquids[k].velocity && spec_.liquids.size() == 1) return spec_.liquids[k].velocity(x);
    // Several regions: the one whose outline contains the node, or is nearest to it.
    double best = std::numeric_limits<double>::max();
    Vec<2> v = Vec<2>::Zero();
    for (const auto& liquid : spec_.liquids) {
      const Wall<2> outline_wall({"", liquid.boundary, Isometry<2>::Identity(), Twist<2>::Zero(), 0});
      const auto near = outline_wall.nearest(Isometry<2>::Identity(), x, 2 * outline_wall.box().diagonal().norm() + 1e3);
      if (near.distance >= best) continue;
      best = near.distance;
      v = liquid.velocity ? liquid.velocity(x) : Vec<2>::Zero();
    }
    return v;
  }

  void outline(const LiquidSpec<2>& liquid) {
    std::vector<CGAL::Polygon_with_holes_2<Kernel>> parts;
    clipped(liquid, walls_).polygons_with_holes(std::back_inserter(parts));
    for (const auto& part : parts) {
      chain(part.outer_boundary());
      for (auto h = part.holes_begin(); h != part.holes_end(); ++h) chain(*h);
    }
  }

  WallTie tie_at(const Vec<2>& x) const {
    for (std::size_t w = 0; w < walls_.walls.size(); ++w) {
      const double tiny = on_wall * walls_.walls[w].box().diagonal().norm();
      const auto near = walls_.walls[w].nearest(walls_.poses[w], x, 2 * tiny);
      if (std::abs(near.distance) < tiny) return {static_cast<int>(w), near.patch, near.vertex};
    }
    return {};
  }

  // Resamples a closed outline between its corners to the size field.
  void chain(const Polygon& polygon) {
    std::vector<Vec<2>> p;
    for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v)
      p.push_back({CGAL::to_double(v->x()), CGAL::to_double(v->y())});
    const std::size_t n = p.size();
    std::vector<WallTie> tie(n);
    for (std::size_t i = 0; i < n; ++i) tie[i] = tie_at(p[i]);
    auto edge_wall = [&](std::size_t i) { return tie_at(0.5 * (p[i] + p[(i + 1) % n])).wall; };
    std::vector<int> wall(n);
    for (std::size_t i = 0; i < n; ++i) wall[i] = edge_wall(i);
    std::vector<std::size_t> corner;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec<2> before = (p[i] - p[(i + n - 1) % n]).normalized(), after = (p[(i + 1) % n] - p[i]).normalized();
      const bool sharp = before.dot(after) < std::cos(30.0 * std::numbers::pi / 180.0);
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
    for (int i = 0; i < count; ++i)
      out_.mesh.boundary.push_back({{first + i, first + (i + 1) % count}, ring_wall[i]});
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

  void refine() {
    std::vector<double>& h = out_.h;
    auto sizes = [&] {
      const SizeField<2> field(spec_.size, walls_, wetted_, out_.nodes.x, out_.mesh);
      h.resize(out_.nodes.size());
      for (std::size_t i = 0; i < h.size(); ++i) h[i] = field(out_.nodes.x[i]);
    };
    sizes();
    const std::vector<Twist<2>> at_rest(walls_.walls.size(), Twist<2>::Zero());
    wet<2>(out_.nodes, h, out_.mesh, walls_, at_rest);
    sizes();
    for (int sweep = 0, settled = 0; settled < smoothing_sweeps; ++sweep) {
      do out_.mesh = recognise<2>(out_.nodes, h, out_.mesh.boundary, walls_, outline_decides);
      while (drop_lost());
      if (settled + 1 == smoothing_sweeps) return;
      const auto report = adapt(out_.nodes, h, out_.mesh, walls_);
      const bool quiet = report.inserted + report.removed < 1 + static_cast<int>(h.size()) / 200;
      if (quiet || sweep > 60) ++settled;
      out_.mesh = recognise<2>(out_.nodes, h, out_.mesh.boundary, walls_, outline_decides);
      smooth(h);
      sizes();
    }
  }

  // Smoothing may push a node through a wall. It has no cell then, and is no drop of water either.
  bool drop_lost() {
    std::vector<int> kept;
    for (std::size_t i = 0; i < out_.nodes.size(); ++i)
      if (!out_.nodes.spray[i]) kept.push_back(static_cast<int>(i));
    if (kept.size() == out_.nodes.size()) return false;
    keep(kept, out_.nodes, out_.h, out_.mesh.boundary);
    return true;
  }

  // Inner nodes move towards the mean of their neighbours, weighted by how far apart they should be.
  void smooth(const std::vector<double>& h) {
    auto& x = out_.nodes.x;
    std::vector<Vec<2>> push(x.size(), Vec<2>::Zero());
    std::vector<double> weight(x.size(), 0.0);
    std::vector<char> fixed(x.size(), 0);
    for (const auto& f : out_.mesh.boundary)
      for (int n : f.nodes) fixed[n] = 1;
    for (const auto& cell : out_.mesh.cells)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          if (a == b) continue;
          const int i = cell[a], j = cell[b];
          const Vec<2> e = x[i] - x[j];
          const double target = 0.5 * (h[i] + h[j]);
          push[i] += e * (target / e.norm() - 1.0);
          weight[i] += 1;
        }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!fixed[i] && weight[i] > 0) x[i] += 1.2 * push[i] / weight[i];
  }

  const FluidSpec<2>& spec_;
  const WallsAt<2>& walls_;
  std::vector<double> wetted_;
  SizeField<2> size_;
  InitialLiquid<2> out_;
};

}  // namespace

template <>
InitialLiquid<2> fill(const FluidSpec<2>& spec, const WallsAt<2>& walls) {
  return Filler(spec, walls).run();
}

template <>
InitialLiquid<3> fill(const FluidSpec<3>&, const WallsAt<3>&) {
  throw std::invalid_argument("filling three-dimensional regions is not available yet");
}

}  // namespace splashdown::fluid
