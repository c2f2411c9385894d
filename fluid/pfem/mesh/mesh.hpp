// The mesh of a step: cells and boundary facets between the nodes at t_n, and what remeshing asks of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/facet.hpp"
#include "core/mirror.hpp"
#include "fluid/pfem/geometry.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

using splashdown::area_vector_of;
using splashdown::corners;
using splashdown::corners_of;
using splashdown::enclosed_volume;
using splashdown::Facet;

/// Simplices between nodes, and the closed boundary of what they fill.
template <int d>
struct Mesh {
  std::vector<std::array<int, d + 1>> cells;  ///< positively oriented simplices
  std::vector<Facet<d>> boundary;             ///< closed: free surface and wetted walls, area vectors out of the fluid
};

/// The share V / (d + 1) of each cell's volume that falls to each of its corners [m^d]. O(cells), on all threads.
template <int d, class Positions>
std::vector<double> volume_shares(const Mesh<d>& mesh, const Positions& x) {
  std::vector<double> share(mesh.cells.size());
  in_parallel(share.size(), [&](std::size_t c) { share[c] = volume<d>(corners(x, mesh.cells[c])) / (d + 1); });
  return share;
}

/// The sum over the cells around each of `nodes` nodes of what `share(c)` gives to each corner of cell c, in ascending order
/// of the cells. O(cells).
template <int d, class Share>
std::vector<double> nodal_sums(const Mesh<d>& mesh, std::size_t nodes, Share share) {
  std::vector<double> sums(nodes, 0.0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double of_corner = share(c);
    for (int n : mesh.cells[c]) sums[n] += of_corner;
  }
  return sums;
}

/// Volume of the cells around each node, shared equally among their corners [m^d].
template <int d, class Positions>
std::vector<double> nodal_volumes(const Mesh<d>& mesh, const Positions& x) {
  const std::vector<double> share = volume_shares(mesh, x);
  return nodal_sums(mesh, x.size(), [&](std::size_t c) { return share[c]; });
}

/// Corners of the facet opposite each corner of a positive simplex, oriented out of it.
template <int d>
inline constexpr std::array<std::array<int, d>, d + 1> opposite;
/// Of a triangle.
template <>
inline constexpr std::array<std::array<int, 2>, 3> opposite<2>{{{1, 2}, {2, 0}, {0, 1}}};
/// Of a tetrahedron.
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

/// Marks with 1 which of `nodes` nodes facets hold, the others with 0.
template <int d>
std::vector<char> nodes_of(const std::vector<Facet<d>>& facets, std::size_t nodes) {
  std::vector<char> held(nodes, 0);
  for (const auto& f : facets)
    for (int n : f.nodes) held[n] = 1;
  return held;
}

/// Whether a facet lies in a plane of symmetry.
template <int corners, class Positions>
bool lies_in(const Mirror& mirror, const Facet<corners>& facet, const Positions& x) {
  constexpr double roundoff = 1e-9;  // of the facet's length
  const double length = (x[facet.nodes[0]] - x[facet.nodes[1]]).norm();
  return std::ranges::all_of(facet.nodes,
                             [&](int n) { return std::abs(x[n][mirror.axis] - mirror.at) <= roundoff * length; });
}

/// Wetted measure of each of `walls` walls: length (2D) [m], area (3D) [m^2].
template <int d, class Positions>
std::vector<double> wetted_measures(const Mesh<d>& mesh, const Positions& x, std::size_t walls) {
  std::vector<double> wetted(walls, 0.0);
  for (const auto& f : mesh.boundary)
    if (f.wall >= 0) wetted[f.wall] += area_vector_of<d>(f, x).norm();
  return wetted;
}

}  // namespace splashdown::fluid
