// Cells and boundary facets between the nodes at t_n.
#pragma once

#include <array>
#include <vector>

#include "core/geometry.hpp"
#include "core/parallel.hpp"

namespace splashdown {

/// A facet of the fluid's boundary: an edge in 2D, a triangle in 3D.
template <int d>
struct Facet {
  std::array<int, d> nodes;  ///< oriented: the area vector points out of the fluid
  int wall = -1;             ///< the wall it is wetted by, -1: free surface
};

/// Simplices between nodes, and the closed boundary of what they fill.
template <int d>
struct Mesh {
  std::vector<std::array<int, d + 1>> cells;  ///< positively oriented simplices
  std::vector<Facet<d>> boundary;             ///< closed: free surface and wetted walls, area vectors out of the fluid
};

/// Corner reader of a cell or facet for the functions of geometry.hpp.
template <class Positions, class Indices>
auto corners(const Positions& x, const Indices& nodes) {
  return [&x, &nodes](int k) { return x[nodes[k]]; };
}

/// Positions of a facet's nodes [m].
template <int d, class Positions>
std::array<Vec<d>, d> corners_of(const Facet<d>& f, const Positions& x) {
  std::array<Vec<d>, d> corner;
  for (int k = 0; k < d; ++k) corner[k] = x[f.nodes[k]];
  return corner;
}

/// Area vector of a facet, out of the fluid [m, m^2].
template <int d, class Positions>
Vec<d> area_vector_of(const Facet<d>& f, const Positions& x) {
  return area_vector(corners_of(f, x));
}

/// Volume enclosed by a closed set of facets: (1/d) sum of x . A.
template <int d, class Positions>
double enclosed_volume(const std::vector<Facet<d>>& facets, const Positions& x) {
  double volume_sum = 0;
  for (const auto& f : facets) volume_sum += x[f.nodes[0]].dot(area_vector_of<d>(f, x)) / d;
  return volume_sum;
}

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

}  // namespace splashdown
