#include "fluid/pfem/water/collision_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/facet_tree.hpp"
#include "fluid/pfem/mesh/parts.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

// What a part hits hardly feels it, where it is fewer elements across and has less of the water's kinetic energy.
constexpr int few = 4;
constexpr double little = 0.01;

/// The free surface of all water but one part.
template <int d>
struct OtherWater {
  std::vector<int> facets;
  FacetTree<d> tree;

  OtherWater(const Nodes<d>& nodes, const Mesh<d>& mesh, const std::vector<int>& part, int without) {
    std::vector<std::array<Vec<d>, d>> corners;
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
      const auto& facet = mesh.boundary[f];
      if (facet.wall >= 0 || part[facet.nodes[0]] == without) continue;
      facets.push_back(static_cast<int>(f));
      corners.push_back(corners_of(facet, nodes.x));
    }
    if (!corners.empty()) tree = FacetTree<d>(corners);
  }
};

}  // namespace

template <int d>
double collision_dt(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
                    std::span<const WallVelocity<d>> velocity, double cfl, double dt) {
  std::vector<int> fast;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.surface[i] && !nodes.spray[i] && nodes.tie[i].wall < 0 && nodes.v[i].norm() * dt > nodes.h[i])
      fast.push_back(static_cast<int>(i));
  if (fast.empty()) return dt;
  const std::vector<int> part = parts_of(mesh, nodes.size());
  std::vector<int> size(nodes.size(), 0);
  std::vector<double> energy(nodes.size(), 0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    ++size[part[i]], energy[part[i]] += nodes.volume[i] * nodes.v[i].squaredNorm();
  const double all = std::accumulate(energy.begin(), energy.end(), 0.0);
  std::map<int, OtherWater<d>> others;
  auto meet = [&](int i, double distance, const Vec<d>& towards, const Vec<d>& relative) {
    const double closing = relative.dot(towards) / (towards.norm() + 1e-300);
    if (closing * dt > distance) dt = std::min(dt, std::max(cfl * nodes.h[i], 0.5 * distance) / closing);
  };
  for (int i : fast) {
    if (size[part[i]] < std::pow(few, d) && energy[part[i]] < little * all) continue;
    const Vec<d>&x = nodes.x[i], &v = nodes.v[i];
    for (std::size_t w = 0; w < walls.walls.size(); ++w) {
      const double reach = (v.norm() + velocity[w].norm()) * dt;
      const auto near = walls.walls[w].nearest(walls.poses[w], x, reach);
      if (near.distance >= reach || near.distance <= 0) continue;
      const Vec<d> of_wall = velocity_at<d>(walls.poses[w], velocity[w], near.point);
      meet(i, near.distance, near.point - x, v - of_wall);
    }
    const auto& other = others.try_emplace(part[i], nodes, mesh, part, part[i]).first->second;
    if (other.facets.empty()) continue;
    const auto hit = other.tree.nearest(x, 2 * v.norm() * dt);
    if (hit.facet < 0) continue;
    Vec<d> of_other = Vec<d>::Zero();
    for (int n : mesh.boundary[other.facets[hit.facet]].nodes) of_other += nodes.v[n] / d;
    meet(i, std::sqrt(hit.squared_distance), hit.point - x, v - of_other);
  }
  return dt;
}

template <int d>
double gap_time(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls) {
  constexpr double thin = 0.01;
  constexpr double never = std::numeric_limits<double>::infinity();
  return least_in_parallel(mesh.cells.size(), [&](std::size_t c) {
    const auto& cell = mesh.cells[c];
    if (!are_between_walls<d>(cell, nodes, walls)) return never;
    const auto gradients = volume_gradients<d>(corners(nodes.x, cell));
    double closing = 0, size = 0;
    for (int k = 0; k <= d; ++k) {
      closing -= gradients.col(k).dot(nodes.v[cell[k]]);
      size += nodes.h[cell[k]] / (d + 1);
    }
    return closing > 0 ? std::max(volume<d>(corners(nodes.x, cell)), thin * std::pow(size, d)) / closing : never;
  });
}

template double gap_time(const Nodes<2>&, const Mesh<2>&, const WallsAt<2>&);
template double gap_time(const Nodes<3>&, const Mesh<3>&, const WallsAt<3>&);
template double collision_dt(const Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>,
                             double, double);
template double collision_dt(const Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>,
                             double, double);

}  // namespace splashdown::fluid
