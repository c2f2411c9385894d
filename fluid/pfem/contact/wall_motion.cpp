#include "fluid/pfem/contact/wall_motion.hpp"

#include <algorithm>
#include <limits>

#include "fluid/pfem/contact/wall.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

template <int d>
WallMotion<d>::WallMotion(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
                          std::span<const char> answers)
    : nodes_(nodes),
      mesh_(mesh),
      walls_(walls.walls),
      wetted_(nodes.size(), 0),
      separations_(separations<d>(nodes, mesh)),
      attached_vertex_(walls.walls.size()) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.tie[i].wall >= 0) tied_.push_back(static_cast<int>(i));
  for (const auto& f : mesh.boundary) {
    if (f.wall < 0) continue;
    for (int n : f.nodes) wetted_[n] = 1;
  }
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
    const bool first_touch = dry[tie.wall] && !walls.poses[tie.wall].shape();
    if (!first_touch && (!wetted_[i] || nodes_.separates[i])) continue;
    const Wall<d>& wall = walls_[tie.wall];
    if (!first_touch && wall.is_smooth(tie)) continue;
    if (!first_touch && wall.is_convex(tie)) {
      slips_[i] = 1;
      edges_.push_back(i);
      continue;
    }
    if (walls.poses[tie.wall].shape()) continue;  // hollow edges that deform: their nodes' mass is the water's alone
    Mat<d> directions = Mat<d>::Identity();
    if (tie.crease >= 0) {
      const Vec<d> along = wall.crease_direction(walls.poses[tie.wall], nodes_.x[i], tie.crease);
      directions -= along * along.transpose();
    }
    hold(i, directions);
  }
}

template <int d>
void WallMotion<d>::meet_pressure(std::span<const int> unknown, std::span<const double> volume) {
  share_momentum<d>(volume, separations_);
  for (int i : tied_)
    if (walls_[nodes_.tie[i].wall].is_smooth(nodes_.tie[i]) && wetted_[i] && unknown[i] >= 0) slips_[i] = 1;
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

// A drop on a wall slides along it: the wall takes what would carry it in, and no more. Within a step it may go farther into a thin
// wall than to its middle: it comes back on its own side.
template <int d>
void WallMotion<d>::move_drop(int i, const WallPlace<d>& pose, double dt, Moved& out) const {
  const WallTie tie = nodes_.tie[i];
  const Wall<d>& wall = walls_[tie.wall];
  const auto near = wall.nearest(pose, out.x[i], wall.diameter());
  if (near.distance >= 0) {
    out.tie[i] = {};
    return;
  }
  const auto own = tie.patch >= 0 ? wall.nearest_on_patch(pose, out.x[i], tie.patch) : near;
  out.u[i] += (own.point - out.x[i]) / dt;  // in a corner it has no normal
  out.x[i] = own.point;
  out.tie[i] = {tie.wall, own.patch};
}

template <int d>
void WallMotion<d>::move_tied(int i, const WallPlace<d>& pose, double dt, Moved& out) const {
  const WallTie tie = nodes_.tie[i];
  const Wall<d>& wall = walls_[tie.wall];
  auto near = tie.sharp() || tie.patch < 0 ? wall.nearest(pose, out.x[i], wall.diameter())
                                           : wall.nearest_on_patch(pose, out.x[i], tie.patch);
  const bool passes_edge = !tie.sharp() && near.sharp() && !wall.is_in_mirror(near.vertex, near.crease);
  if (passes_edge) {
    // The wall guides the node up to its edge: what flies off does not turn into the wall behind it.
    const Vec<d> guided = out.x[i] - (out.x[i] - near.point).dot(near.normal) * near.normal;
    const bool wet_behind = attached(tie.wall, near);
    near = wall.nearest(pose, out.x[i], wall.diameter());
    if (!wet_behind && wall.nearest(pose, guided, wall.diameter()).distance > 0) {
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
  if (!slips_[i] && !nodes_.separates[i]) out.u[i] = (out.x[i] - nodes_.x[i]) / dt;
}

template <int d>
void WallMotion<d>::move(std::span<const Vec<d>> v, std::span<const WallPlace<d>> poses, double dt, Moved& out) const {
  const std::size_t count = nodes_.size();
  out.x.resize(count);
  out.u.assign(v.begin(), v.end());
  out.tie = nodes_.tie;
  in_parallel(count, [&](std::size_t i) { out.x[i] = nodes_.x[i] + dt * v[i]; });
  in_parallel(tied_.size(), [&](std::size_t k) {
    const int i = tied_[k];
    const WallPlace<d>& pose = poses[nodes_.tie[i].wall];
    if (nodes_.spray[i])
      move_drop(i, pose, dt, out);
    else
      move_tied(i, pose, dt, out);
  });
  mix_with_upstream<d>(separations_, out.u);
  out.slides = by_flux_;
  for (int f : chords_)
    if (is_chord(f, out.tie)) out.slides.push_back(f);
}

template class WallMotion<2>;
template class WallMotion<3>;

}  // namespace splashdown::fluid
