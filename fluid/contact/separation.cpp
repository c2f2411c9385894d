#include "fluid/contact/separation.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "fluid/contact/wall.hpp"

namespace splashdown::fluid {

template <int d>
void separate(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at, std::span<const Twist<d>> velocities,
              double gravity) {
  struct Edge {
    Vec<d> normal = Vec<d>::Zero();
    bool both_sides = false;
    double squared_speed = 0;  // sum
    int upstream = 0;
  };
  std::vector<int> index(nodes.size(), -1);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const WallTie& tie = nodes.tie[i];
    nodes.separates[i] = nodes.surface[i] && tie.sharp() && at.walls[tie.wall].is_convex(tie);
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
    const bool calm = e.upstream > 0 && 0.5 * e.squared_speed <= e.upstream * gravity * nodes.h[i];
    if (e.both_sides || calm) nodes.separates[i] = 0;
  }
}
template <int d>
std::vector<Separation<d>> separations(const Nodes<d>& nodes, const Mesh<d>& mesh) {
  std::vector<Separation<d>> all;
  auto separates = [&](int n) { return nodes.separates[n] != 0; };
  std::vector<int> index(nodes.size(), -1);
  for (bool inner : {true, false})  // neighbours at the edge themselves serve where there are no others
    for (const auto& f : mesh.boundary) {
      if (f.wall < 0) continue;
      for (int n : f.nodes) {
        if (!separates(n) || (!inner && index[n] >= 0)) continue;
        for (int other : f.nodes) {
          if (other == n || separates(other) == inner) continue;
          if (index[n] < 0) index[n] = static_cast<int>(all.size()), all.push_back({n, {}, Vec<d>::Zero()});
          all[index[n]].upstream.push_back({other});
        }
      }
    }
  for (const auto& f : mesh.boundary)
    for (int n : f.nodes)
      if (index[n] >= 0) all[index[n]].area += area_vector_of<d>(f, nodes.x);
  return all;
}

template <int d>
void share_momentum(std::span<const double> volume, std::span<Separation<d>> separations) {
  std::map<int, int> meets;  // edge nodes that a neighbour has
  for (const auto& s : separations)
    for (const auto& up : s.upstream) ++meets[up.node];
  for (auto& s : separations)
    for (auto& up : s.upstream) {
      const double of_edge = std::max(0.0, volume[s.at]), of_neighbour = std::max(0.0, volume[up.node]);
      const double a = of_edge / static_cast<double>(s.upstream.size()), b = of_neighbour / meets[up.node];
      if (a + b == 0) continue;
      up.taken = of_edge > 0 ? a * b / (a + b) / of_edge : 0.0;
      up.given = of_neighbour > 0 ? a * b / (a + b) / of_neighbour : 0.0;
    }
}

template <int d>
void mix_with_upstream(std::span<const Separation<d>> separations, std::span<Vec<d>> u) {
  std::vector<std::pair<int, Vec<d>>> changes;
  for (const auto& s : separations)
    for (const auto& up : s.upstream) {
      Vec<d> past = u[up.node] - u[s.at];
      if (d == 3 && !s.area.isZero(0)) past -= past.dot(s.area) / s.area.squaredNorm() * s.area;
      changes.emplace_back(s.at, up.taken * past);
      changes.emplace_back(up.node, -up.given * past);
    }
  for (const auto& [node, change] : changes) u[node] += change;
}

template void separate(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const Twist<2>>, double);
template void separate(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const Twist<3>>, double);
template std::vector<Separation<2>> separations(const Nodes<2>&, const Mesh<2>&);
template std::vector<Separation<3>> separations(const Nodes<3>&, const Mesh<3>&);
template void share_momentum<2>(std::span<const double>, std::span<Separation<2>>);
template void share_momentum<3>(std::span<const double>, std::span<Separation<3>>);
template void mix_with_upstream<2>(std::span<const Separation<2>>, std::span<Vec<2>>);
template void mix_with_upstream<3>(std::span<const Separation<3>>, std::span<Vec<3>>);

}  // namespace splashdown::fluid
