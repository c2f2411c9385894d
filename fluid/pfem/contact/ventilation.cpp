#include "fluid/pfem/contact/ventilation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "fluid/pfem/contact/wall.hpp"
#include "fluid/pfem/geometry.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

// Of the dynamic pressure: what a laminar boundary layer recovers before it separates, 0.06 on a circular cylinder
// (104.5 degrees) to 0.23 where the flow slows down linearly (Howarth 1938). Noise in a jet stays below.
constexpr double suction = 0.1;
constexpr double off_wall = 1e-6;  // over h: roundoff does not find a node on the wall again that has left it

// |v - w|^2 / 2 at a node.
template <int d>
double slip_energy(const Nodes<d>& nodes, std::size_t n, int wall, const WallsAt<d>& at,
                   std::span<const WallVelocity<d>> velocities) {
  return 0.5 * (nodes.v[n] - velocity_at<d>(at.poses[wall], velocities[wall], nodes.x[n])).squaredNorm();
}

// Means over the wetted facets around nodes; 0 elsewhere. Single nodes of films have pressures of either sign.
template <int d>
std::vector<double> mean_pressures(const Nodes<d>& nodes, const Mesh<d>& mesh) {
  std::vector<double> mean(nodes.size(), 0.0), area(nodes.size(), 0.0);
  for (const auto& f : mesh.boundary) {
    if (f.wall < 0) continue;
    const double of_facet = area_vector_of<d>(f, nodes.x).norm();
    double p = 0;
    for (int n : f.nodes) p += nodes.wall_pressure[n] / d;
    for (int n : f.nodes) mean[n] += of_facet * p, area[n] += of_facet;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) mean[i] = nodes.surface[i] || area[i] == 0 ? 0.0 : mean[i] / area[i];
  return mean;
}

// Connected sets of wetted nodes with p < 0.
class SuctionRegions {
 public:
  template <int d>
  SuctionRegions(const Nodes<d>& nodes, const Mesh<d>& mesh, const std::vector<double>& p)
      : next_(nodes.size()), lowest_(nodes.size()) {
    std::iota(next_.begin(), next_.end(), 0);
    std::iota(lowest_.begin(), lowest_.end(), 0);
    for (const auto& f : mesh.boundary) {
      int first = -1;
      for (int n : f.nodes) {
        if (f.wall < 0 || p[n] >= 0 || nodes.tie[n].wall != f.wall) continue;
        if (first >= 0) next_[name(n)] = name(first);
        first = n;
      }
    }
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
      if (int& lowest = lowest_[name(i)]; p[i] < p[lowest]) lowest = i;
  }
  /// Where the pressure is lowest in the region around this node.
  int lowest(int node) { return lowest_[name(node)]; }

 private:
  int name(int n) {
    while (next_[n] != n) n = next_[n] = next_[next_[n]];
    return n;
  }
  std::vector<int> next_, lowest_;  // towards the node that the region is named by; of named regions
};

// Nodes around which no cell holds two inner nodes: in films of less than two elements.
template <int d>
std::vector<char> thin_places(const Nodes<d>& nodes, const Mesh<d>& mesh) {
  const std::vector<char> on_boundary = nodes_of(mesh.boundary, nodes.size());
  std::vector<char> thin(nodes.size(), 1);
  for (const auto& cell : mesh.cells)
    if (std::count_if(cell.begin(), cell.end(), [&](int n) { return !on_boundary[n]; }) >= 2)
      for (int n : cell) thin[n] = 0;
  return thin;
}

// Nodes at which air needs no time: all of the plane's, whose films are resolved less, and those of gaps between walls, which
// close faster than water passes an element.
template <int d>
std::vector<char> without_memory(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at) {
  if constexpr (d == 2) return std::vector<char>(nodes.size(), 1);
  std::vector<char> forget(nodes.size(), 0);
  for (const auto& cell : mesh.cells)
    if (are_between_walls<d>(cell, nodes, at))
      for (int n : cell) forget[n] = 1;
  return forget;
}

}  // namespace

template <int d>
void average_wall_pressure(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at,
                           std::span<const WallVelocity<d>> velocities, std::span<const int> unknown,
                           std::span<const double> repair_impulse, double kick) {
  const std::vector<char> forget = without_memory(nodes, mesh, at);
  in_parallel(nodes.size(), [&](std::size_t n) {
    double& mean = nodes.wall_pressure[n];
    const int wall = nodes.tie[n].wall;
    if (wall < 0) {
      mean = 0;
      return;
    }
    if (forget[n]) {
      mean = nodes.p[n];
      return;
    }
    const double repair = unknown[n] < 0 ? 0.0 : repair_impulse[unknown[n]] / kick;
    const double way = kick * std::sqrt(2 * slip_energy(nodes, n, wall, at, velocities));
    mean += (nodes.p[n] + repair - mean) * way / (way + nodes.h[n]);
  });
}

template <int d>
void ventilate(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at, std::span<const WallVelocity<d>> velocities,
               double density, double gravity) {
  const std::vector<double> mean = mean_pressures(nodes, mesh);
  const std::vector<char> thin = thin_places(nodes, mesh);
  SuctionRegions regions(nodes, mesh, mean);
  auto energy = [&](int n, int wall) { return slip_energy(nodes, n, wall, at, velocities); };
  auto strong = [&](double p, int n, int wall) { return p < -suction * density * energy(n, wall); };
  auto leaves = [&](int n, int wall) {
    if (strong(nodes.wall_pressure[n], n, wall)) return true;
    const int patch = nodes.tie[n].patch;
    if (patch < 0 || at.walls[wall].is_flat(patch)) return false;
    if (mean[n] >= 0 || energy(n, wall) <= gravity * nodes.h[n]) return false;
    const int lowest = regions.lowest(n);
    // In 3D the root of a jet is no thicker than that itself.
    return (d == 2 && thin[n]) || strong(mean[lowest], lowest, wall);
  };
  struct Leaving {
    int node;
    Vec<d> step;
  };
  std::vector<Leaving> leaving;
  for (const auto& f : mesh.boundary) {
    if (f.wall < 0) continue;
    if (std::none_of(f.nodes.begin(), f.nodes.end(), [&](int n) { return nodes.surface[n]; })) continue;
    const Vec<d> off = -area_vector_of<d>(f, nodes.x).normalized();
    for (int n : f.nodes)
      if (!nodes.surface[n] && nodes.tie[n].wall == f.wall && leaves(n, f.wall))
        leaving.push_back({n, off_wall * nodes.h[n] * off});
  }
  for (const Leaving& l : leaving) {
    nodes.tie[l.node] = {};
    nodes.x[l.node] += l.step;
  }
}

template void average_wall_pressure(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>,
                                    std::span<const int>, std::span<const double>, double);
template void average_wall_pressure(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>,
                                    std::span<const int>, std::span<const double>, double);
template void ventilate(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>, double, double);
template void ventilate(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>, double, double);

}  // namespace splashdown::fluid
