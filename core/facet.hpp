// Oriented facets between numbered points: the boundary of a fluid.
#pragma once

#include <array>
#include <vector>

#include "core/geometry.hpp"

namespace splashdown {

/// A facet of a fluid's boundary: an edge in 2D, a triangle in 3D.
template <int d>
struct Facet {
  std::array<int, d> nodes;  ///< numbers of its points; oriented: the area vector points out of the fluid
  int wall = -1;             ///< the wall it is wetted by, -1: free surface
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

}  // namespace splashdown
