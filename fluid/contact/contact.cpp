#include "fluid/contact/contact.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "fluid/mesh/boundary_edges.hpp"
#include "fluid/mesh/inside.hpp"
#include "fluid/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr double on_facet = 0.02;  // a sharp vertex this close to a wetted facet (over h) lies on it
constexpr double snap = 0.3;       // a boundary node this close to a sharp vertex (over h) moves onto it

template <int d>
double diameter(const Wall<d>& wall) {
  return wall.box().diagonal().norm();
}

template <int d>
void tie_arrivals(Nodes<d>& nodes, std::span<const double> h, const WallsAt<d>& at,
                  std::span<const Twist<d>> velocities) {
  in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.tie[i].wall >= 0) return;
    for (std::size_t w = 0; w < at.walls.size(); ++w) {
      if (!at.walls[w].may_touch(at.poses[w], nodes.x[i], 0)) continue;
      // Drops may cross more than an element in a step, nodes of the liquid may not.
      const double reach = nodes.spray[i] ? diameter(at.walls[w]) : h[i];
      const auto near = at.walls[w].nearest(at.poses[w], nodes.x[i], reach);
      const Vec<d> arm = nodes.x[i] - at.poses[w].translation();
      // A node that a neighbouring edge let go may touch the wall behind the edge while it flies away.
      if (near.distance > 0 || (nodes.v[i] - rigid_velocity<d>(velocities[w], arm)).dot(near.normal) > 0) continue;
      nodes.x[i] = near.point;
      nodes.tie[i] = {static_cast<int>(w), near.patch, -1};
      break;
    }
  });
}

// The liquid's boundary, as corners of walls ask for it. A few look at all facets: that is cheaper than what answers many,
// which is built once, and anew when the boundary has changed.
template <int d>
class Shore {
 public:
  Shore(const Nodes<d>& nodes, const Mesh<d>& mesh, std::size_t questions)
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
void split_facet(Nodes<d>& nodes, std::vector<double>& h, Mesh<d>& mesh, int facet, const Vec<d>& point, WallTie tie) {
  const Facet<d> old = mesh.boundary[facet];
  Vec<d> v = Vec<d>::Zero();
  double p = 0, size = 0;
  for (int n : old.nodes) v += nodes.v[n] / d, p += nodes.p[n] / d, size += h[n] / d;
  const int m = nodes.add(point, v, p, tie, old.wall < 0);
  h.push_back(size);
  for (int k = 0; k < d; ++k) {
    Facet<d> part = old;
    part.nodes[k] = m;
    if (k == 0)
      mesh.boundary[facet] = part;
    else
      mesh.boundary.push_back(part);
  }
}

template <int d>
void occupy_corners(Nodes<d>& nodes, std::vector<double>& h, Mesh<d>& mesh, const WallsAt<d>& at) {
  constexpr double near = 2;  // over h: corners farther from the boundary have not been passed by it in a step
  struct Corner {
    int wall, vertex;
  };
  std::vector<Corner> dry;
  for (int w = 0; w < static_cast<int>(at.walls.size()); ++w) {
    std::vector<char> taken(at.walls[w].spec().surface.vertices.cols(), 0);
    for (const WallTie& t : nodes.tie)
      if (t.wall == w && t.vertex >= 0) taken[t.vertex] = 1;
    for (int v : at.walls[w].corners())
      if (!taken[v]) dry.push_back({w, v});
  }
  if (dry.empty() || h.empty()) return;
  const double reach = near * *std::max_element(h.begin(), h.end());
  Shore<d> shore(nodes, mesh, dry.size());
  for (const auto [w, v] : dry) {
    const Vec<d> point = at.walls[w].vertex(at.poses[w], v);
    const auto hit = shore.nearest(point, reach);
    if (hit.facet < 0) continue;
    const Facet<d>& f = mesh.boundary[hit.facet];
    int closest = f.nodes[0];
    bool touches = f.wall == w;
    for (int n : f.nodes) {
      touches = touches || nodes.tie[n].wall == w;
      if ((nodes.x[n] - point).norm() < (nodes.x[closest] - point).norm()) closest = n;
    }
    const double size = h[closest];
    const bool arrived =
        hit.distance < (touches ? on_facet : 1e-9) * size || (hit.distance < near * size && shore.encloses(point));
    if (!arrived) continue;
    const WallTie tie{w, -1, v};
    if ((nodes.x[closest] - point).norm() < snap * size && nodes.tie[closest].vertex < 0) {
      nodes.x[closest] = point;
      nodes.tie[closest] = tie;
    } else {
      split_facet(nodes, h, mesh, hit.facet, point, tie);
    }
    shore.changed();
  }
}

// The edge leaves a smooth patch of the wall over one of its creases.
template <int d>
bool passes_crease(const Nodes<d>& nodes, std::span<const double> h, const Wall<d>& wall, const Isometry<d>& pose,
                   int w, int a, int b, typename Wall<d>::Crossing& at) {
  const WallTie &tie_a = nodes.tie[a], &tie_b = nodes.tie[b];
  if (tie_a.wall != w || tie_a.sharp()) return false;
  const bool turns = tie_b.wall == w;
  if (turns && (tie_b.sharp() || tie_a.patch == tie_b.patch)) return false;
  at = wall.nearest_crease(pose, nodes.x[a], nodes.x[b]);
  return at.distance < (turns ? (nodes.x[a] - nodes.x[b]).norm() : on_facet * h[a]);
}

template <int d>
void occupy_creases(Nodes<d>& nodes, std::vector<double>& h, Mesh<d>& mesh, const WallsAt<d>& at) {
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
      if (passes_crease<d>(nodes, h, at.walls[w], at.poses[w], w, a, b, pass.at)) passes.push_back(pass);
    }
  if (passes.empty()) return;
  const BoundaryEdges<d> edges(mesh.boundary, nodes.size());
  std::vector<char> touched(nodes.size(), 0);
  for (const Pass& pass : passes) {
    if (touched[pass.a] || touched[pass.b]) continue;
    bool taken = false;  // by a third node of the facets at the edge
    edges.around(mesh.boundary, pass.a, pass.b, [&](int f) {
      for (int n : mesh.boundary[f].nodes)
        taken = taken || (nodes.tie[n].wall == pass.wall && nodes.tie[n].crease == pass.at.crease &&
                          (nodes.x[n] - pass.at.point).norm() < snap * h[n]);
    });
    if (taken) continue;
    const WallTie tie{pass.wall, -1, -1, pass.at.crease};
    const int closest = pass.at.share < 0.5 ? pass.a : pass.b;
    if ((nodes.x[closest] - pass.at.point).norm() < snap * h[closest] && !nodes.tie[closest].sharp()) {
      nodes.x[closest] = pass.at.point;
      nodes.tie[closest] = tie;
      touched[closest] = 1;
      continue;
    }
    touched[pass.a] = touched[pass.b] = 1;
    const double t = pass.at.share;
    const int m = nodes.add(pass.at.point, (1 - t) * nodes.v[pass.a] + t * nodes.v[pass.b],
                            (1 - t) * nodes.p[pass.a] + t * nodes.p[pass.b], tie, false);
    h.push_back((1 - t) * h[pass.a] + t * h[pass.b]);
    edges.split(mesh.boundary, pass.a, pass.b, m);
  }
}

}  // namespace

template <int d>
void wet(Nodes<d>& nodes, std::vector<double>& h, Mesh<d>& mesh, const WallsAt<d>& walls,
         std::span<const Twist<d>> velocities) {
  tie_arrivals<d>(nodes, h, walls, velocities);
  occupy_corners(nodes, h, mesh, walls);
  occupy_creases(nodes, h, mesh, walls);
}

template <int d>
void separate(Nodes<d>& nodes, std::span<const double> h, const Mesh<d>& mesh, const WallsAt<d>& at,
              std::span<const Twist<d>> velocities, double gravity) {
  struct Edge {
    Vec<d> normal = Vec<d>::Zero();
    bool both_sides = false;
    double squared_speed = 0;  // sum
    int upstream = 0;
  };
  std::vector<int> index(nodes.size(), -1);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes.separates[i] = nodes.surface[i] && nodes.tie[i].sharp();
    if (!nodes.separates[i] || nodes.tie[i].crease < 0) continue;
    index[i] = static_cast<int>(edges.size());
    edges.emplace_back();
  }
  if (edges.empty()) return;
  for (const auto& f : mesh.boundary) {
    if (f.wall < 0) continue;
    const Vec<d> normal = area_vector_of<d>(f, nodes.x).normalized();
    for (int n : f.nodes) {
      if (index[n] < 0 || nodes.tie[n].wall != f.wall) continue;
      Edge& e = edges[index[n]];
      if (e.normal.isZero(0)) e.normal = normal;
      e.both_sides = e.both_sides || e.normal.dot(normal) < least_smooth_cosine;
      for (int other : f.nodes) {
        if (nodes.surface[other]) continue;
        const Vec<d> arm = nodes.x[other] - at.poses[f.wall].translation();
        e.squared_speed += (nodes.v[other] - rigid_velocity<d>(velocities[f.wall], arm)).squaredNorm();
        ++e.upstream;
      }
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (index[i] < 0) continue;
    const Edge& e = edges[index[i]];
    const bool calm = e.upstream > 0 && 0.5 * e.squared_speed <= e.upstream * gravity * h[i];
    if (e.both_sides || calm) nodes.separates[i] = 0;
  }
}

template <int d>
WallMotion<d>::WallMotion(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
                          std::span<const char> answers)
    : nodes_(nodes), mesh_(mesh), walls_(walls.walls), wetted_(nodes.size(), 0), attached_vertex_(walls.walls.size()) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.tie[i].wall >= 0) tied_.push_back(static_cast<int>(i));
  for (const auto& f : mesh.boundary) {
    if (f.wall < 0) continue;
    for (int n : f.nodes) wetted_[n] = 1;
  }
  find_separations(mesh);
  for (std::size_t w = 0; w < walls_.size(); ++w)
    attached_vertex_[w].assign(walls_[w].spec().surface.vertices.cols(), 0);
  for (int i : tied_)
    if (const WallTie& tie = nodes.tie[i]; tie.sharp() && wetted_[i]) {
      if (tie.vertex >= 0)
        attached_vertex_[tie.wall][tie.vertex] = !nodes.surface[i];
      else
        on_creases_.push_back(i);
    }
  find_edges(walls, answers);
}

// The node at an edge moves with it; the water does where the edge is hollow, and flows around it elsewhere. An edge that is
// the first of a dry body to dip into the surface takes its node along, and shares its momentum with it.
template <int d>
void WallMotion<d>::find_edges(const WallsAt<d>& walls, std::span<const char> answers) {
  auto hold = [&](int node, const Mat<d>& directions) {
    const int wall = nodes_.tie[node].wall;
    held_.push_back({node, wall, nodes_.x[node] - walls.poses[wall].translation(), directions});
  };
  std::vector<char> dry(answers.begin(), answers.end());
  for (const auto& f : mesh_.boundary)
    if (f.wall >= 0) dry[f.wall] = 0;
  slips_.assign(nodes_.size(), 0);
  for (int i : tied_) {
    const WallTie& tie = nodes_.tie[i];
    if (!tie.sharp() || nodes_.spray[i]) continue;
    const bool first_touch = dry[tie.wall];
    if (!first_touch && (!wetted_[i] || nodes_.separates[i])) continue;
    const Wall<d>& wall = walls_[tie.wall];
    if (!first_touch && wall.is_convex(tie)) {
      slips_[i] = 1;
      edges_.push_back(i);
      continue;
    }
    Mat<d> directions = Mat<d>::Identity();
    if (tie.crease >= 0) {
      const Vec<d> along = wall.crease_direction(walls.poses[tie.wall], nodes_.x[i], tie.crease);
      directions -= along * along.transpose();
    }
    hold(i, directions);
  }
}

template <int d>
void WallMotion<d>::meet_pressure(std::span<const int> unknown) {
  for (int i : tied_)
    if (!nodes_.tie[i].sharp() && wetted_[i] && unknown[i] >= 0) slips_[i] = 1;
  for (int f = 0; f < static_cast<int>(mesh_.boundary.size()); ++f) {
    const Facet<d>& facet = mesh_.boundary[f];
    if (facet.wall < 0) continue;
    if (std::any_of(facet.nodes.begin(), facet.nodes.end(), [&](int n) { return slips_[n] != 0; }))
      by_flux_.push_back(f);
    else if (is_chord(f, nodes_.tie))
      chords_.push_back(f);
  }
}

template <int d>
void WallMotion<d>::convect(std::span<const Vec<d>> x, double dt, std::span<Vec<d>> u) const {
  struct Inflow {
    Vec<d> sum = Vec<d>::Zero();
    double weight = 0, fastest = 0;
  };
  if (edges_.empty()) return;
  std::vector<int> slot(nodes_.size(), -1);
  for (std::size_t k = 0; k < edges_.size(); ++k) slot[edges_[k]] = static_cast<int>(k);
  std::vector<Inflow> inflow(edges_.size());
  for (int f : by_flux_) {
    const auto& nodes = mesh_.boundary[f].nodes;
    for (int n : nodes)
      for (int other : nodes) {
        if (slot[n] < 0 || slot[other] >= 0) continue;
        const Vec<d> past = u[n] - (x[n] - nodes_.x[n]) / dt, from = x[other] - x[n];
        const double rate = -past.dot(from) / from.squaredNorm();
        if (rate <= 0) continue;
        Inflow& in = inflow[slot[n]];
        in.sum += rate * u[other], in.weight += rate, in.fastest = std::max(in.fastest, rate);
      }
  }
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    const Inflow& in = inflow[k];
    if (in.weight > 0) u[edges_[k]] += std::min(1.0, dt * in.fastest) * (in.sum / in.weight - u[edges_[k]]);
  }
}

template <int d>
void WallMotion<d>::find_separations(const Mesh<d>& mesh) {
  auto separates = [&](int n) { return nodes_.separates[n] != 0; };
  std::vector<int> index(nodes_.size(), -1);
  for (bool inner : {true, false})  // neighbours at the edge themselves serve where there are no others
    for (const auto& f : mesh.boundary) {
      if (f.wall < 0) continue;
      for (int n : f.nodes) {
        if (!separates(n) || (!inner && index[n] >= 0)) continue;
        for (int other : f.nodes) {
          if (other == n || separates(other) == inner) continue;
          if (index[n] < 0)
            index[n] = static_cast<int>(separations_.size()), separations_.push_back({n, {}, Vec<d>::Zero()});
          separations_[index[n]].upstream.push_back(other);
        }
      }
    }
  for (const auto& f : mesh.boundary)
    for (int n : f.nodes)
      if (index[n] >= 0) separations_[index[n]].area += area_vector_of<d>(f, nodes_.x);
}

// The water wets both sides of the edge there: at the node on it that is nearest.
template <int d>
bool WallMotion<d>::attached(int wall, const typename Wall<d>::Near& edge) const {
  if (edge.vertex >= 0) return attached_vertex_[wall][edge.vertex];
  double least = std::numeric_limits<double>::infinity();
  bool wet = false;
  for (int i : on_creases_) {
    const double distance = (nodes_.x[i] - edge.point).squaredNorm();
    if (nodes_.tie[i].wall != wall || nodes_.tie[i].crease != edge.crease || distance >= least) continue;
    least = distance;
    wet = !nodes_.surface[i];
  }
  return wet;
}

template <int d>
bool WallMotion<d>::is_chord(int facet, std::span<const WallTie> tie) const {
  const Facet<d>& f = mesh_.boundary[facet];
  if (f.wall < 0) return false;
  int patch = -1;
  bool curved = false;
  for (int n : f.nodes) {
    if (tie[n].wall != f.wall || nodes_.separates[n]) return false;
    if (tie[n].sharp()) continue;
    curved =
        curved || (patch >= 0 && tie[n].patch != patch) || tie[n].patch < 0 || !walls_[f.wall].is_flat(tie[n].patch);
    patch = tie[n].patch;
  }
  return curved;
}

template <int d>
void WallMotion<d>::move(std::span<const Vec<d>> v, std::span<const Isometry<d>> poses, double dt, Moved& out) const {
  const std::size_t count = nodes_.size();
  out.x.resize(count);
  out.u.assign(v.begin(), v.end());
  out.tie = nodes_.tie;
  in_parallel(count, [&](std::size_t i) { out.x[i] = nodes_.x[i] + dt * v[i]; });
  in_parallel(tied_.size(), [&](std::size_t k) {
    const int i = tied_[k];
    const WallTie tie = nodes_.tie[i];
    const Wall<d>& wall = walls_[tie.wall];
    const Isometry<d>& pose = poses[tie.wall];
    if (nodes_.spray[i]) {
      // A drop on a wall slides along it: the wall takes what would carry it in, and no more.
      const auto near = wall.nearest(pose, out.x[i], diameter(wall));
      if (near.distance >= 0) {
        out.tie[i] = {};
        return;
      }
      out.x[i] = near.point;
      const double inwards = std::min(0.0, (nodes_.x[i] + dt * v[i] - near.point).dot(near.normal) / dt);
      out.u[i] -= inwards * near.normal;
      out.tie[i] = {tie.wall, near.patch};
      return;
    }
    auto near = tie.sharp() || tie.patch < 0 ? wall.nearest(pose, out.x[i], diameter(wall))
                                             : wall.nearest_on_patch(pose, out.x[i], tie.patch);
    const bool passes_edge = !tie.sharp() && near.sharp();
    if (passes_edge) {
      // The wall guides the node up to its edge: what flies off does not turn into the wall behind it.
      const Vec<d> guided = out.x[i] - (out.x[i] - near.point).dot(near.normal) * near.normal;
      const bool wet_behind = attached(tie.wall, near);
      near = wall.nearest(pose, out.x[i], diameter(wall));
      if (!wet_behind && wall.nearest(pose, guided, diameter(wall)).distance > 0) {
        out.x[i] = guided;
        out.u[i] = (out.x[i] - nodes_.x[i]) / dt;
        out.tie[i] = {};
        return;
      }
    } else if (!wetted_[i] && near.distance > 0) {
      out.tie[i] = {};
      return;
    }
    out.x[i] = tie.vertex >= 0   ? wall.vertex(pose, tie.vertex)
               : tie.crease >= 0 ? wall.nearest_on_crease(pose, out.x[i], tie.crease)
                                 : near.point;
    if (passes_edge) out.tie[i].patch = near.patch;
    if (!slips_[i]) out.u[i] = (out.x[i] - nodes_.x[i]) / dt;
  });
  for (const Separation& s : separations_) {
    Vec<d> sum = Vec<d>::Zero();
    for (int n : s.upstream) sum += out.u[n];
    Vec<d> past = sum / static_cast<double>(s.upstream.size()) - out.u[s.at];
    if (d == 3 && !s.area.isZero(0)) past -= past.dot(s.area) / s.area.squaredNorm() * s.area;
    out.u[s.at] += past;
  }
  out.slides = by_flux_;
  for (int f : chords_)
    if (is_chord(f, out.tie)) out.slides.push_back(f);
}

template void wet(Nodes<2>&, std::vector<double>&, Mesh<2>&, const WallsAt<2>&, std::span<const Twist<2>>);
template void wet(Nodes<3>&, std::vector<double>&, Mesh<3>&, const WallsAt<3>&, std::span<const Twist<3>>);
template void separate(Nodes<2>&, std::span<const double>, const Mesh<2>&, const WallsAt<2>&, std::span<const Twist<2>>,
                       double);
template void separate(Nodes<3>&, std::span<const double>, const Mesh<3>&, const WallsAt<3>&, std::span<const Twist<3>>,
                       double);
template class WallMotion<2>;
template class WallMotion<3>;

}  // namespace splashdown::fluid
