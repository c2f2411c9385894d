#include "fluid/pfem/mesh/drops/sheets.hpp"

#include <algorithm>
#include <map>

#include "fluid/pfem/mesh/conservation/field_energy.hpp"
#include "fluid/pfem/mesh/drops/coalescence.hpp"
#include "fluid/pfem/mesh/parts.hpp"

namespace splashdown::fluid {
namespace {

// Nodes all of whose cells lie between free surfaces. What closes a gap between two waters is none: nodes do not carry it yet.
template <int d>
std::vector<char> of_sheets(const Nodes<d>& nodes, const Mesh<d>& mesh) {
  std::vector<char> flies(nodes.size(), 0), stays(nodes.size(), 0);
  for (const auto& cell : mesh.cells) {
    const bool sheet = std::ranges::all_of(cell, [&](int n) { return nodes.surface[n] && nodes.tie[n].wall < 0; }) &&
                       !joins_parts<d>(cell, nodes);
    for (int n : cell) (sheet ? flies : stays)[n] = 1;
  }
  for (std::size_t i = 0; i < flies.size(); ++i) flies[i] = flies[i] && !stays[i];
  return flies;
}

// Water of which less than half would stay, but some, is no pool that a sheet leaves: its mesh is coarse, and what would fly off comes
// back to more than it left.
template <int d>
void keep_coarse_water(const Nodes<d>& nodes, const Mesh<d>& mesh, std::vector<char>& flies) {
  const std::vector<int> part = parts_of(mesh, nodes.size());
  std::vector<double> all(nodes.size(), 0.0), flying(nodes.size(), 0.0);
  for (const auto& cell : mesh.cells) {
    const double volume_of_cell = volume<d>(corners(nodes.x, cell));
    all[part[cell[0]]] += volume_of_cell;
    if (std::ranges::any_of(cell, [&](int n) { return flies[n]; })) flying[part[cell[0]]] += volume_of_cell;
  }
  for (std::size_t i = 0; i < flies.size(); ++i)
    flies[i] = flies[i] && (flying[part[i]] <= 0.5 * all[part[i]] || flying[part[i]] == all[part[i]]);
}

template <int d>
void hand_over_volume(const std::array<int, d + 1>& cell, const std::vector<char>& flies, const std::vector<Vec<d>>& x,
                      Nodes<d>& nodes) {
  const auto flying = std::ranges::count_if(cell, [&](int n) { return flies[n]; });
  const double share = volume<d>(corners(x, cell)) / (d + 1);
  for (int stays : cell) {
    if (flies[stays]) continue;
    const double given = std::clamp(share, 0.0, std::max(0.0, nodes.volume[stays])) / static_cast<double>(flying);
    if (given == 0) continue;
    nodes.volume[stays] -= given * static_cast<double>(flying);
    for (int n : cell) {
      if (!flies[n]) continue;
      const double had = std::max(0.0, nodes.volume[n]);
      nodes.v[n] = (had * nodes.v[n] + given * nodes.v[stays]) / (had + given);
      nodes.x[n] = (had * nodes.x[n] + given * x[stays]) / (had + given);
      nodes.volume[n] += given;
    }
  }
}

// What flies takes along the energy that the field had in the cell.
template <int d>
void hand_over_energy(const std::array<int, d + 1>& cell, const std::vector<char>& flies, Nodes<d>& nodes) {
  const auto flying = std::ranges::count_if(cell, [&](int n) { return flies[n]; });
  const double share = cell_energy<d>(cell, nodes.x, nodes.v) / (d + 1);
  for (int n : cell)
    nodes.field_energy[n] +=
        flies[n] ? share * static_cast<double>(d + 1 - flying) / static_cast<double>(flying) : -share;
}

}  // namespace

template <int d>
void let_fly(Nodes<d>& nodes, Mesh<d>& mesh, FlatCells<d>& flat_cells, const std::vector<char>& flies) {
  const auto goes = [&](const auto& simplex) { return std::ranges::any_of(simplex, [&](int n) { return flies[n]; }); };
  const auto sheet = std::ranges::stable_partition(mesh.cells, [&](const auto& cell) { return !goes(cell); });
  if (sheet.empty()) return;
  // Facets of the cells that go: those of the boundary go with them, the others are the boundary of what stays.
  std::map<std::array<int, d>, bool> outside;
  const auto key = [](std::array<int, d> facet) {
    std::ranges::sort(facet);
    return facet;
  };
  for (const auto& cell : sheet) hand_over_energy<d>(cell, flies, nodes);
  const std::vector<Vec<d>> x = nodes.x;
  for (const auto& cell : sheet) {
    hand_over_volume<d>(cell, flies, x, nodes);
    for (int k = 0; k <= d; ++k) outside[key(facet_nodes(cell, k))] = false;
  }
  const auto opens = [&](const std::array<int, d + 1>& crack) {
    bool beside = goes(crack);
    for (int k = 0; k <= d && !beside; ++k) beside = outside.contains(key(facet_nodes(crack, k)));
    for (int k = 0; k <= d && beside; ++k) outside[key(facet_nodes(crack, k))] = false;
    return beside;
  };
  while (std::erase_if(flat_cells, opens) > 0) {
  }
  std::erase_if(mesh.boundary, [&](const auto& f) {
    const auto found = outside.find(key(f.nodes));
    if (found == outside.end()) return false;
    found->second = true;
    return true;
  });
  std::erase_if(outside, [](const auto& entry) { return entry.second; });
  mesh.cells.erase(sheet.begin(), sheet.end());
  if (!outside.empty())
    for (const auto& cell : mesh.cells)
      for (int k = 0; k <= d; ++k)
        if (const auto facet = facet_nodes(cell, k); outside.contains(key(facet))) mesh.boundary.push_back({facet});
  std::vector<char> has_cells(nodes.size(), 0);
  for (const auto& cell : mesh.cells)
    for (int n : cell) has_cells[n] = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!has_cells[i]) nodes.spray[i] = 1, nodes.surface[i] = 0;
}

template <int d>
void let_sheets_fly(Nodes<d>& nodes, Mesh<d>& mesh, FlatCells<d>& flat_cells, const std::function<bool(int)>& may_fly) {
  std::vector<char> flies = of_sheets(nodes, mesh);
  for (std::size_t i = 0; i < flies.size(); ++i) flies[i] = flies[i] && may_fly(static_cast<int>(i));
  if (std::ranges::find(flies, 1) == flies.end()) return;
  keep_coarse_water<d>(nodes, mesh, flies);
  let_fly<d>(nodes, mesh, flat_cells, flies);
}

template void let_fly(Nodes<2>&, Mesh<2>&, FlatCells<2>&, const std::vector<char>&);
template void let_fly(Nodes<3>&, Mesh<3>&, FlatCells<3>&, const std::vector<char>&);
template void let_sheets_fly(Nodes<2>&, Mesh<2>&, FlatCells<2>&, const std::function<bool(int)>&);
template void let_sheets_fly(Nodes<3>&, Mesh<3>&, FlatCells<3>&, const std::function<bool(int)>&);

}  // namespace splashdown::fluid
