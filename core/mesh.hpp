// Cells and boundary facets between the nodes at t_n.
#pragma once

#include <array>
#include <vector>

#include "core/geometry.hpp"
#include "core/parallel.hpp"

namespace splashdown {

template <int d>
struct Facet {
  std::array<int, d> nodes;  ///< oriented: the area vector points out of the fluid
  int wall = -1;             ///< the wall it is wetted by, -1: free surface
};

/// Corners of the facet opposite each corner of a positive simplex, oriented out of it.
template <int d>
inline constexpr std::array<std::array<int, d>, d + 1> opposite;
template <>
inline constexpr std::array<std::array<int, 2>, 3> opposite<2>{{{1, 2}, {2, 0}, {0, 1}}};
template <>
inline constexpr std::array<std::array<int, 3>, 4> opposite<3>{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Nodes of the facet opposite a corner of the cell.
template <std::size_t corners>
auto facet_nodes(const std::array<int, corners>& cell, int corner) {
  constexpr int d = static_cast<int>(corners) - 1;
  std::array<int, d> nodes;
  for (int j = 0; j < d; ++j) nodes[j] = cell[opposite<d>[corner][j]];
  return nodes;
}

template <int d>
struct Mesh {
  std::vector<std::array<int, d + 1>> cells;  ///< positively oriented simplices
  std::vector<Facet<d>> boundary;
};

/// Marks with 1 which of `nodes` nodes facets hold, the others with 0.
template <int d>
std::vector<char> nodes_of(const std::vector<Facet<d>>& facets, std::size_t nodes) {
  std::vector<char> held(nodes, 0);
  for (const auto& f : facets)
    for (int n : f.nodes) held[n] = 1;
  return held;
}

/// Corner reader of a cell or facet for the functions of geometry.hpp.
template <class Positions, class Indices>
auto corners(const Positions& x, const Indices& nodes) {
  return [&x, &nodes](int k) { return x[nodes[k]]; };
}

template <int d, class Positions>
std::array<Vec<d>, d> corners_of(const Facet<d>& f, const Positions& x) {
  std::array<Vec<d>, d> corner;
  for (int k = 0; k < d; ++k) corner[k] = x[f.nodes[k]];
  return corner;
}

template <int d, class Positions>
Vec<d> area_vector_of(const Facet<d>& f, const Positions& x) {
  return area_vector(corners_of(f, x));
}

/// Wetted measure of each of `walls` walls: length (2D) [m], area (3D) [m^2].
template <int d, class Positions>
std::vector<double> wetted_measures(const Mesh<d>& mesh, const Positions& x, std::size_t walls) {
  std::vector<double> wetted(walls, 0.0);
  for (const auto& f : mesh.boundary)
    if (f.wall >= 0) wetted[f.wall] += area_vector_of<d>(f, x).norm();
  return wetted;
}

/// Volume enclosed by a closed set of facets: (1/d) sum of x . A.
template <int d, class Positions>
double enclosed_volume(const std::vector<Facet<d>>& facets, const Positions& x) {
  double volume_sum = 0;
  for (const auto& f : facets) volume_sum += x[f.nodes[0]].dot(area_vector_of<d>(f, x)) / d;
  return volume_sum;
}

/// Volume of the cells around each node, shared equally among their corners [m^d].
template <int d, class Positions>
std::vector<double> nodal_volumes(const Mesh<d>& mesh, const Positions& x) {
  std::vector<double> volumes(x.size(), 0.0), share(mesh.cells.size());
  in_parallel(share.size(), [&](std::size_t c) { share[c] = volume<d>(corners(x, mesh.cells[c])) / (d + 1); });
  for (std::size_t c = 0; c < share.size(); ++c)
    for (int n : mesh.cells[c]) volumes[n] += share[c];
  return volumes;
}

}  // namespace splashdown
