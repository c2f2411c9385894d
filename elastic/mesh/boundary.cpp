#include "elastic/mesh/boundary.hpp"

#include <algorithm>

namespace splashdown::elastic {
namespace {

/// The facets that a quadratic one is cut into, by its own nodes: corners first, then middles in the order of `cell_edges`.
template <int d>
constexpr auto parts_of_facet() {
  if constexpr (d == 2)
    return std::array<std::array<int, 2>, 2>{{{0, 2}, {2, 1}}};
  else
    return std::array<std::array<int, 3>, 4>{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
}

}  // namespace

template <int d>
Boundary<d> boundary_of(const SolidMesh<d>& mesh) {
  constexpr auto parts = parts_of_facet<d>();
  Boundary<d> all;
  for (const auto& facet : mesh.facets) all.nodes.insert(all.nodes.end(), facet.begin(), facet.end());
  std::ranges::sort(all.nodes);
  all.nodes.erase(std::unique(all.nodes.begin(), all.nodes.end()), all.nodes.end());
  all.surface.vertices = mesh.nodes(Eigen::all, all.nodes);
  all.surface.facets.resize(d, static_cast<Eigen::Index>(mesh.facets.size() * parts.size()));
  Eigen::Index at = 0;
  for (const auto& facet : mesh.facets)
    for (const auto& part : parts) {
      for (int k = 0; k < d; ++k) {
        const int node = facet[static_cast<std::size_t>(part[static_cast<std::size_t>(k)])];
        all.surface.facets(k, at) = static_cast<int>(std::ranges::lower_bound(all.nodes, node) - all.nodes.begin());
      }
      ++at;
    }
  return all;
}

template Boundary<2> boundary_of<2>(const SolidMesh<2>&);
template Boundary<3> boundary_of<3>(const SolidMesh<3>&);

}  // namespace splashdown::elastic
