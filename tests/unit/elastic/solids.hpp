// Solids that the tests share.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "elastic/assembly/solid.hpp"
#include "elastic/mesh/outline_mesh.hpp"
#include "elastic/steps/scheme.hpp"
#include "tests/unit/core/outlines.hpp"

namespace splashdown::elastic {

using outlines::polygon;

/// A box from the origin: n boxes along each axis, cut into two triangles or six tetrahedra each.
template <int d>
SolidMesh<d> box_mesh(const Vec<d>& size, const std::array<int, d>& n) {
  std::array<int, d> stride;
  int count = 1;
  for (int k = 0; k < d; ++k) {
    stride[k] = count;
    count *= n[k] + 1;
  }
  Points<d> corners(d, count);
  Simplices<d> simplices;
  for (int a = 0; a < count; ++a) {
    bool begins_box = true;
    for (int k = 0; k < d; ++k) {
      const int along = a / stride[k] % (n[k] + 1);
      corners(k, a) = size[k] * along / n[k];
      begins_box &= along < n[k];
    }
    if (!begins_box) continue;
    // One simplex a way through the box along its axes (Kuhn).
    std::array<int, d> way;
    for (int k = 0; k < d; ++k) way[k] = k;
    do {
      std::array<int, d + 1> simplex{a};
      for (int k = 0; k < d; ++k) simplex[k + 1] = simplex[k] + stride[way[k]];
      simplices.push_back(simplex);
    } while (std::next_permutation(way.begin(), way.end()));
  }
  return quadratic_mesh<d>(corners, simplices);
}

/// Each inner corner away from where it was, by a share of the distance to its neighbours.
template <int d>
SolidMesh<d> shaken(const SolidMesh<d>& mesh, double by) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-by, by);
  Points<d> nodes = mesh.nodes;
  std::vector<bool> at_boundary(static_cast<std::size_t>(mesh.size()), false);
  for (const auto& facet : mesh.facets)
    for (const int a : facet) at_boundary[static_cast<std::size_t>(a)] = true;
  std::vector<bool> is_corner(at_boundary.size(), false);
  for (const auto& cell : mesh.cells)
    for (int i = 0; i <= d; ++i) is_corner[static_cast<std::size_t>(cell[i])] = true;
  for (int a = 0; a < mesh.size(); ++a)
    if (is_corner[static_cast<std::size_t>(a)] && !at_boundary[static_cast<std::size_t>(a)])
      for (double& x : nodes.col(a)) x += uniform(random);
  Simplices<d> simplices;
  for (const auto& cell : mesh.cells) {
    simplices.emplace_back();
    std::copy_n(cell.begin(), d + 1, simplices.back().begin());
  }
  Points<d> corners = nodes;
  return quadratic_mesh<d>(corners, simplices);
}

/// No load.
inline std::function<Field(double)> unloaded(const System& system) {
  return [size = system.size()](double) -> Field { return Field::Zero(size); };
}
/// The same at all times.
inline std::function<Field(double)> always(Field load) {
  return [load = std::move(load)](double) { return load; };
}
/// At rest, undeformed.
inline SolidState at_rest(const System& system) {
  const Field zero = Field::Zero(system.size());
  return {0, zero, zero, zero};
}
/// Equilibrium under a load, from the undeformed solid.
inline Field equilibrium(const System& system, const Field& load) {
  SolidState end;
  const auto status = steady({.system = &system, .load = always(load)})->step(at_rest(system), 1, end);
  if (!status.ok()) throw std::runtime_error(status.cause);
  return end.u;
}

/// Aluminium's Poisson ratio; a modulus that makes speeds of waves of order 1.
inline constexpr Isotropic soft{.young_modulus = 1, .poisson_ratio = 0.33};

}  // namespace splashdown::elastic
