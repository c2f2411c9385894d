// The quadratic simplex: a triangle of six nodes, a tetrahedron of ten. Corners come first, then the middles of `cell_edges`.
// In barycentric coordinates L of the corners (Zienkiewicz, Taylor: The Finite Element Method, volume 1)
//
//   N_corner = L_i (2 L_i - 1),   N_middle = 4 L_i L_j
//
// Rules integrate polynomials of degree 4 exactly (triangle: Dunavant 1985, six points; segment: Gauss, three), of degree 5
// on the tetrahedron (Walkington 2000, fourteen points): masses are exact on straight cells.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"

namespace splashdown {

/// Nodes of a cell: 6 and 10.
template <int d>
inline constexpr int cell_nodes = (d + 1) * (d + 2) / 2;
/// Nodes of a facet, itself a quadratic simplex: 3 and 6.
template <int d>
inline constexpr int facet_nodes = cell_nodes<d - 1>;
/// Edges of a cell: 3 and 6.
template <int d>
inline constexpr int edge_count = d*(d + 1) / 2;

/// Corners at the ends of the edge whose middle is node d + 1 + k, in Gmsh's order; a segment's only edge, a triangle's three
/// and a tetrahedron's six are the first of these.
inline constexpr std::array<std::array<int, 2>, 6> cell_edges = {{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}};
/// Barycentric coordinates, one a corner; they sum to 1.
template <int d>
using Barycentric = Eigen::Matrix<double, d + 1, 1>;

/// Where a node of a cell lies in it.
template <int d>
Barycentric<d> node_place(int node) {
  Barycentric<d> at = Barycentric<d>::Zero();
  if (node <= d)
    at[node] = 1;
  else
    for (const int corner : cell_edges[static_cast<std::size_t>(node - d - 1)]) at[corner] = 0.5;
  return at;
}

/// Values of a cell's shape functions.
template <int d>
Eigen::Matrix<double, cell_nodes<d>, 1> shapes(const Barycentric<d>& L) {
  Eigen::Matrix<double, cell_nodes<d>, 1> N;
  for (int i = 0; i <= d; ++i) N[i] = L[i] * (2 * L[i] - 1);
  for (int e = 0; e < edge_count<d>; ++e) N[d + 1 + e] = 4 * L[cell_edges[e][0]] * L[cell_edges[e][1]];
  return N;
}

/// Their derivatives by the coordinates of corners 1 to d, that of corner 0 being what is left of 1: a column a node.
template <int d>
Eigen::Matrix<double, d, cell_nodes<d>> shape_slopes(const Barycentric<d>& L) {
  Eigen::Matrix<double, d + 1, cell_nodes<d>> by_all = Eigen::Matrix<double, d + 1, cell_nodes<d>>::Zero();
  for (int i = 0; i <= d; ++i) by_all(i, i) = 4 * L[i] - 1;
  for (int e = 0; e < edge_count<d>; ++e) {
    const auto [i, j] = cell_edges[e];
    by_all(i, d + 1 + e) = 4 * L[j];
    by_all(j, d + 1 + e) = 4 * L[i];
  }
  return by_all.template bottomRows<d>().rowwise() - by_all.row(0);
}

/// A point of an integration rule and its share of the simplex.
template <int d>
struct RulePoint {
  Barycentric<d> at;  ///< where it is
  double weight;      ///< what of the simplex it stands for
};
/// The rule of a segment, a triangle or a tetrahedron; weights sum to 1.
template <int d>
const std::vector<RulePoint<d>>& rule();
template <>
const std::vector<RulePoint<1>>& rule<1>();
template <>
const std::vector<RulePoint<2>>& rule<2>();
template <>
const std::vector<RulePoint<3>>& rule<3>();

}  // namespace splashdown
