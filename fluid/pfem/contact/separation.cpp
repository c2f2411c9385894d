#include "fluid/pfem/contact/separation.hpp"

#include <algorithm>
#include <map>

#include "fluid/pfem/contact/wall.hpp"

namespace splashdown::fluid {

template <int d>
void separate(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at, std::span<const WallVelocity<d>> velocities,
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
        const Vec<d> of_wall = velocity_at<d>(at.poses[f.wall], velocities[f.wall], nodes.x[other]);
        e.squared_speed += (nodes.v[other] - of_wall).squaredNorm();
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
  std::vector<Separation<d>> pairs;
  std::vector<char> meets(nodes.size(), 0);
  const auto separates = [&](int n) { return nodes.separates[n] != 0; };
  const auto find = [&](auto&& are_pair) {
    for (const auto& f : mesh.boundary) {
      if (f.wall < 0) continue;
      for (int n : f.nodes)
        for (int other : f.nodes)
          if (n != other && separates(n) && are_pair(n, other)) pairs.push_back({n, other});
    }
  };
  find([&](int, int other) { return !separates(other); });
  for (const auto& pair : pairs) meets[pair.edge] = 1;
  find([&](int n, int other) { return !meets[n] && separates(other) && (meets[other] || n < other); });
  if (pairs.empty()) return pairs;
  std::vector<Vec<d>> area(nodes.size(), Vec<d>::Zero());  // around edge nodes
  for (const auto& f : mesh.boundary)
    for (int n : f.nodes)
      if (separates(n)) area[n] += area_vector_of<d>(f, nodes.x);
  for (auto& pair : pairs) pair.area = area[pair.edge] + area[pair.neighbour];
  return pairs;
}

template <int d>
void share_momentum(std::span<const double> volume, std::span<Separation<d>> separations) {
  std::map<int, int> pairs;  // of a node
  for (const auto& s : separations) ++pairs[s.edge], ++pairs[s.neighbour];
  for (auto& s : separations) {
    const double of_edge = std::max(0.0, volume[s.edge]), of_neighbour = std::max(0.0, volume[s.neighbour]);
    const double a = of_edge / pairs[s.edge], b = of_neighbour / pairs[s.neighbour];
    if (a + b == 0) continue;
    s.taken = of_edge > 0 ? a * b / (a + b) / of_edge : 0.0;
    s.given = of_neighbour > 0 ? a * b / (a + b) / of_neighbour : 0.0;
  }
}

template <int d>
void mix_with_upstream(std::span<const Separation<d>> separations, std::span<Vec<d>> u) {
  std::vector<Vec<d>> past(separations.size());
  for (std::size_t k = 0; k < past.size(); ++k) {
    const Separation<d>& s = separations[k];
    past[k] = u[s.neighbour] - u[s.edge];
    if (d == 3 && !s.area.isZero(0)) past[k] -= past[k].dot(s.area) / s.area.squaredNorm() * s.area;
  }
  for (std::size_t k = 0; k < past.size(); ++k) {
    const Separation<d>& s = separations[k];
    u[s.edge] += s.taken * past[k];
    u[s.neighbour] -= s.given * past[k];
  }
}

template void separate(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>, double);
template void separate(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>, double);
template std::vector<Separation<2>> separations(const Nodes<2>&, const Mesh<2>&);
template std::vector<Separation<3>> separations(const Nodes<3>&, const Mesh<3>&);
template void share_momentum<2>(std::span<const double>, std::span<Separation<2>>);
template void share_momentum<3>(std::span<const double>, std::span<Separation<3>>);
template void mix_with_upstream<2>(std::span<const Separation<2>>, std::span<Vec<2>>);
template void mix_with_upstream<3>(std::span<const Separation<3>>, std::span<Vec<3>>);

}  // namespace splashdown::fluid
