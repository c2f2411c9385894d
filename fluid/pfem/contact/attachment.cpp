#include "fluid/pfem/contact/attachment.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/closest_point.hpp"
#include "core/facet_tree.hpp"
#include "core/surface/inside.hpp"
#include "fluid/pfem/mesh/adapt/boundary_edges.hpp"
#include "fluid/pfem/mesh/delaunay/delaunay.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr double on_facet = 0.02;  // a sharp vertex this close to a wetted facet (over h) lies on it
constexpr double deep = 0.05;      // a node this deep in a solid (over h) has come through its surface
constexpr double snap = 0.3;       // a boundary node this close to a sharp vertex (over h) moves onto it

/// What came through a thin wall's one side may be nearer to the other: where it was a step ago, `from`, says which side it is on.
/// `x` without its way into the solid, if it was outside then or had not come farther than `little`.
template <int d>
std::optional<Vec<d>> on_own_side(const Wall<d>& wall, const WallPlace<d>& pose, const Vec<d>& from, const Vec<d>& x,
                                  double little) {
  constexpr int halvings = 20;
  const auto nearest = [&](const Vec<d>& point) { return wall.nearest(pose, point, wall.diameter()); };
  Vec<d> entrance = from;
  if (const double distance = nearest(from).distance; distance > 0) {
    double outside = 0, within = 1;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (outside + within);
      (nearest(from + middle * (x - from)).distance > 0 ? outside : within) = middle;
    }
    entrance = from + within * (x - from);
  } else if (distance < -little) {
    return {};
  }
  const Vec<d> normal = nearest(entrance).normal;
  const double depth = (entrance - x).dot(normal);
  return depth > 0 ? std::optional<Vec<d>>(x + depth * normal) : std::nullopt;
}

// Nodes of the water in the plane of symmetry are tied to the tank's side there. For hulls they are like others within the
// water: those that a hull has met belong to its line in the plane, and what leaves that line belongs to the tank again.
template <int d>
void tie_in_mirror(Nodes<d>& nodes, const WallsAt<d>& at, std::span<const WallVelocity<d>> velocities) {
  constexpr double in_plane = 1e-5;  // over h: more than ventilation lifts a node off its wall
  const auto tank = std::ranges::find_if(at.walls, [](const Wall<d>& wall) { return wall.ends_at_mirror(); });
  if (tank == at.walls.end()) return;
  const auto t = static_cast<int>(tank - at.walls.begin());
  const Mirror mirror = *tank->spec().mirror;
  in_parallel(nodes.size(), [&](std::size_t i) {
    WallTie& tie = nodes.tie[i];
    if ((tie.wall >= 0 && tie.wall != t) || tie.sharp() || nodes.spray[i]) return;
    if (mirror.distance<d>(nodes.x[i]) > in_plane * nodes.h[i]) return;
    const Vec<d> x = mirror.onto<d>(nodes.x[i]);
    if (tie.wall < 0) {
      nodes.x[i] = x;
      tie = {t, tank->nearest(at.poses[t], x, tank->diameter()).patch, -1};
    }
    for (int w = 0; w < t && d == 3; ++w) {
      const Wall<d>& hull = at.walls[w];
      if (!hull.spec().mirror || !hull.may_touch(at.poses[w], x, 0)) continue;
      const auto near = hull.nearest(at.poses[w], x, hull.diameter());
      if (near.distance > 0) continue;
      const Vec<d> v = nodes.v[i] - velocity_at<d>(at.poses[w], velocities[w], x);
      if (v.dot(near.normal) > 0 && near.distance > -deep * nodes.h[i]) continue;
      const auto line = hull.nearest_in_mirror(at.poses[w], x);
      if (line.crease < 0) continue;
      nodes.x[i] = line.point;
      tie = {w, -1, -1, line.crease};
      return;
    }
  });
}

template <int d>
void tie_arrivals(Nodes<d>& nodes, const WallsAt<d>& at, std::span<const WallVelocity<d>> velocities, double dt) {
  in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.tie[i].wall >= 0) return;
    for (std::size_t w = 0; w < at.walls.size(); ++w) {
      if (!at.walls[w].may_touch(at.poses[w], nodes.x[i], 0)) continue;
      // Drops may cross more than an element in a step, nodes of the liquid may not.
      const double reach = nodes.spray[i] ? at.walls[w].diameter() : nodes.h[i];
      auto near = at.walls[w].nearest(at.poses[w], nodes.x[i], reach);
      if (near.distance > 0) continue;
      const Vec<d> v = nodes.v[i] - velocity_at<d>(at.poses[w], velocities[w], nodes.x[i]);
      if (v.dot(near.normal) > 0) {
        // A node that a neighbouring edge let go may touch the wall behind the edge while it flies away.
        if (near.distance > -deep * nodes.h[i]) continue;
        const auto own = on_own_side<d>(at.walls[w], at.poses[w], nodes.x[i] - dt * v, nodes.x[i], deep * nodes.h[i]);
        if (!own) continue;
        near = at.walls[w].nearest(at.poses[w], *own, at.walls[w].diameter());
      }
      nodes.x[i] = near.point;
      nodes.tie[i] = {static_cast<int>(w), near.patch, -1};
      break;
    }
  });
}

// The liquid's boundary, as corners of walls ask for it. A few look at all facets: that is cheaper than what answers many,
// which is built once, and anew when the boundary has changed.
template <int d>
class LiquidBoundary {
 public:
  LiquidBoundary(const Nodes<d>& nodes, const Mesh<d>& mesh, std::size_t questions)
      : nodes_(nodes), mesh_(mesh), many_(questions > few) {}
  struct Hit {
    int facet = -1;
    double distance = std::numeric_limits<double>::max();
  };
  /// The nearest facet within `reach`.
  Hit nearest(const Vec<d>& point, double reach) {
    if (!many_) return nearest_of_all(point, reach);
    if (tree_.empty()) {
      std::vector<std::array<Vec<d>, d>> facets;
      for (const auto& f : mesh_.boundary) facets.push_back(corners_of(f, nodes_.x));
      tree_ = FacetTree<d>(facets);
    }
    const auto hit = tree_.nearest(point, reach);
    return hit.facet < 0 ? Hit{} : Hit{hit.facet, std::sqrt(hit.squared_distance)};
  }
  bool encloses(const Vec<d>& point) {
    if (!many_) return is_inside<d>(nodes_.x, mesh_.boundary, point);
    if (!inside_) inside_.emplace(nodes_.x, mesh_.boundary);
    return (*inside_)(point);
  }
  void changed() {
    tree_ = {};
    inside_.reset();
  }

 private:
  static constexpr std::size_t few = 30;
  Hit nearest_of_all(const Vec<d>& point, double reach) const {
    Hit best{-1, reach};
    for (std::size_t f = 0; f < mesh_.boundary.size(); ++f) {
      const auto corner = corners_of(mesh_.boundary[f], nodes_.x);
      Eigen::AlignedBox<double, d> box(corner[0]);
      for (int k = 1; k < d; ++k) box.extend(corner[k]);
      if (box.squaredExteriorDistance(point) > best.distance * best.distance) continue;
      const double distance = (closest_on(corner, point) - point).norm();
      if (distance < best.distance) best = {static_cast<int>(f), distance};
    }
    return best;
  }

  const Nodes<d>& nodes_;
  const Mesh<d>& mesh_;
  bool many_;
  FacetTree<d> tree_;
  std::optional<InsideTest<d>> inside_;
};

template <int d>
int add_on_facet(Nodes<d>& nodes, const Facet<d>& facet, const Vec<d>& point, WallTie tie) {
  Vec<d> v = Vec<d>::Zero();
  double p = 0, size = 0;
  for (int n : facet.nodes) v += nodes.v[n] / d, p += nodes.p[n] / d, size += nodes.h[n] / d;
  const int added = nodes.add(point, v, p, tie, facet.wall < 0, size);
  nodes.compress_as(added, facet.nodes);
  return added;
}

template <int d>
void split_facet(Mesh<d>& mesh, int facet, int node) {
  const Facet<d> old = mesh.boundary[facet];
  for (int k = 0; k < d; ++k) {
    Facet<d> part = old;
    part.nodes[k] = node;
    if (k == 0)
      mesh.boundary[facet] = part;
    else
      mesh.boundary.push_back(part);
  }
}

struct DryCorner {
  int wall, vertex;
  int node;  // that a mesh has left within the water, -1: none
};

// Corners that no node holds, and those whose node is left within the water, which happens only where triangulations do
// not keep the facets of walls.
template <int d>
std::vector<DryCorner> dry_corners(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at) {
  constexpr int none = -1, settled = -2;
  std::vector<DryCorner> dry;
  std::vector<char> on_boundary;
  for (int w = 0; w < static_cast<int>(at.walls.size()); ++w) {
    if (at.walls[w].corners().empty()) continue;
    if (!keeps_facets<d> && on_boundary.empty()) on_boundary = nodes_of(mesh.boundary, nodes.size());
    std::vector<int> taken(at.walls[w].spec().surface.vertices.cols(), none);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const WallTie& t = nodes.tie[i]; t.wall == w && t.vertex >= 0)
        taken[t.vertex] = keeps_facets<d> || on_boundary[i] || nodes.spray[i] ? settled : static_cast<int>(i);
    for (int v : at.walls[w].corners())
      if (taken[v] != settled) dry.push_back({w, v, taken[v]});
  }
  return dry;
}

template <int d>
bool occupy_corners(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& at) {
  constexpr double near = 2;  // over h: corners farther from the boundary have not been passed by it in a step
  const auto dry = dry_corners(nodes, mesh, at);
  if (dry.empty() || nodes.size() == 0) return false;
  const double reach = near * std::ranges::max(nodes.h);
  LiquidBoundary<d> boundary(nodes, mesh, dry.size());
  bool any = false;
  for (const auto [w, v, within] : dry) {
    const Vec<d> point = at.walls[w].vertex(at.poses[w], v);
    const auto hit = boundary.nearest(point, reach);
    if (hit.facet < 0) continue;
    const Facet<d>& f = mesh.boundary[hit.facet];
    int closest = f.nodes[0];
    bool touches = f.wall == w;
    for (int n : f.nodes) {
      touches = touches || nodes.tie[n].wall == w;
      if ((nodes.x[n] - point).norm() < (nodes.x[closest] - point).norm()) closest = n;
    }
    const double size = nodes.h[closest];
    const bool arrived =
        hit.distance < (touches ? on_facet : 1e-9) * size || (hit.distance < near * size && boundary.encloses(point));
    if (!arrived) continue;
    any = true;
    const WallTie tie{w, -1, v};
    if (within >= 0) {
      split_facet(mesh, hit.facet, within);
    } else if ((nodes.x[closest] - point).norm() < snap * size && nodes.tie[closest].vertex < 0) {
      nodes.x[closest] = point;
      nodes.tie[closest] = tie;
    } else {
      split_facet(mesh, hit.facet, add_on_facet(nodes, mesh.boundary[hit.facet], point, tie));
    }
    boundary.changed();
  }
  return any;
}

// The edge leaves a smooth patch of the wall over one of its creases.
template <int d>
bool passes_crease(const Nodes<d>& nodes, const Wall<d>& wall, const WallPlace<d>& pose, int w, int a, int b,
                   typename Wall<d>::Crossing& at) {
  const WallTie &tie_a = nodes.tie[a], &tie_b = nodes.tie[b];
  if (tie_a.wall != w || tie_a.sharp()) return false;
  const bool turns = tie_b.wall == w;
  if (turns && (tie_b.sharp() || tie_a.patch == tie_b.patch)) return false;
  at = wall.nearest_crease(pose, nodes.x[a], nodes.x[b]);
  return at.distance < (turns ? (nodes.x[a] - nodes.x[b]).norm() : on_facet * nodes.h[a]);
}

template <int d>
bool occupy_creases(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& at) {
  struct Pass {
    int a, b, wall;
    typename Wall<d>::Crossing at;
  };
  std::vector<Pass> passes;
  for (const auto& f : mesh.boundary)
    for (int k = 0; k < d; ++k) {
      const int a = f.nodes[k], b = f.nodes[(k + 1) % d], w = nodes.tie[a].wall;
      if (w < 0 || !at.walls[w].has_creases()) continue;
      Pass pass{a, b, w, {}};
      if (passes_crease<d>(nodes, at.walls[w], at.poses[w], w, a, b, pass.at)) passes.push_back(pass);
    }
  if (passes.empty()) return false;
  const BoundaryEdges<d> edges(mesh.boundary, nodes.size());
  std::vector<char> touched(nodes.size(), 0);
  bool any = false;
  for (const Pass& pass : passes) {
    if (touched[pass.a] || touched[pass.b]) continue;
    bool taken = false;  // by a third node of the facets at the edge
    edges.around(mesh.boundary, pass.a, pass.b, [&](int f) {
      for (int n : mesh.boundary[f].nodes)
        taken = taken || (nodes.tie[n].wall == pass.wall && nodes.tie[n].crease == pass.at.crease &&
                          (nodes.x[n] - pass.at.point).norm() < snap * nodes.h[n]);
    });
    if (taken) continue;
    any = true;
    const WallTie tie{pass.wall, -1, -1, pass.at.crease};
    const int closest = pass.at.share < 0.5 ? pass.a : pass.b;
    if ((nodes.x[closest] - pass.at.point).norm() < snap * nodes.h[closest] && !nodes.tie[closest].sharp()) {
      nodes.x[closest] = pass.at.point;
      nodes.tie[closest] = tie;
      touched[closest] = 1;
      continue;
    }
    touched[pass.a] = touched[pass.b] = 1;
    const double t = pass.at.share;
    const int m = nodes.add(pass.at.point, (1 - t) * nodes.v[pass.a] + t * nodes.v[pass.b],
                            (1 - t) * nodes.p[pass.a] + t * nodes.p[pass.b], tie, false,
                            (1 - t) * nodes.h[pass.a] + t * nodes.h[pass.b]);
    nodes.compress_as(m, std::array{pass.a, pass.b});
    edges.split(mesh.boundary, pass.a, pass.b, m);
  }
  return any;
}

}  // namespace

template <int d>
bool attach_nodes(Nodes<d>& nodes, Mesh<d>& mesh, const WallsAt<d>& walls, std::span<const WallVelocity<d>> velocities,
                  double dt) {
  tie_in_mirror<d>(nodes, walls, velocities);
  tie_arrivals<d>(nodes, walls, velocities, dt);
  const bool corners = occupy_corners(nodes, mesh, walls), creases = occupy_creases(nodes, mesh, walls);
  return corners || creases;
}

template bool attach_nodes(Nodes<2>&, Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>, double);
template bool attach_nodes(Nodes<3>&, Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>, double);

}  // namespace splashdown::fluid
