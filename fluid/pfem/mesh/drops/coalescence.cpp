#include "fluid/pfem/mesh/drops/coalescence.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace splashdown::fluid {

template <int d>
bool joins_parts(const std::array<int, d + 1>& cell, const Nodes<d>& nodes) {
  int first = -1;
  return std::ranges::any_of(cell, [&](int n) {
    if (first < 0) first = nodes.part[n];
    return nodes.part[n] >= 0 && nodes.part[n] != first;
  });
}

template <int d>
std::vector<Facet<d>> smaller_parts_first(const std::vector<Facet<d>>& boundary, const Nodes<d>& nodes) {
  std::map<int, double> volumes;  // of parts
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.part[i] >= 0) volumes[nodes.part[i]] += nodes.volume[i];
  auto volume_of = [&](const Facet<d>& f) {
    const int n = *std::ranges::max_element(f.nodes, {}, [&](int i) { return nodes.part[i]; });
    return nodes.part[n] < 0 ? std::numeric_limits<double>::infinity() : volumes.at(nodes.part[n]);
  };
  std::vector<Facet<d>> sorted = boundary;
  std::ranges::stable_sort(sorted, {}, volume_of);
  return sorted;
}

template <int d>
void mix_joined(const Mesh<d>& mesh, const std::vector<int>& part, Nodes<d>& nodes) {
  std::map<int, double> joined;  // new water around nodes
  for (const auto& cell : mesh.cells) {
    if (!joins_parts<d>(cell, nodes)) continue;
    for (int n : cell) joined[n] += volume<d>(corners(nodes.x, cell)) / (d + 1);
  }
  nodes.part = part;
  if (joined.empty()) return;
  std::vector<VelocityMoments<d>> all(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) all[part[i]] += nodes.carried(i);
  for (const auto& [i, share] : joined) {
    const double carried = nodes.volume[i];
    if (share > 0) nodes.v[i] = (carried * nodes.v[i] + share * all[part[i]].mean_velocity()) / (carried + share);
  }
}

template <int d>
void mix_absorbed(Nodes<d>& nodes, const Mesh<d>& mesh) {
  constexpr double landed = 3;
  const std::vector<double> now = nodal_volumes(mesh, nodes.x);
  std::vector<int> lands;
  std::vector<char> is_landing(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    is_landing[i] = nodes.volume[i] > 0 && now[i] > landed * nodes.volume[i];
    if (is_landing[i]) lands.push_back(static_cast<int>(i));
  }
  if (lands.empty()) return;
  std::vector<Vec<d>> momentum(nodes.size(), Vec<d>::Zero());  // of neighbours, over density
  std::vector<double> weight(nodes.size(), 0.0);
  for (const auto& cell : mesh.cells)
    for (int n : cell) {
      if (!is_landing[n]) continue;
      for (int other : cell)
        if (!is_landing[other]) momentum[n] += now[other] * nodes.v[other], weight[n] += now[other];
    }
  for (int n : lands) {
    if (weight[n] == 0) continue;  // drops that meet in the air
    const Vec<d> around = momentum[n] / weight[n];
    nodes.v[n] = around + nodes.volume[n] / now[n] * (nodes.v[n] - around);
    nodes.p[n] = 0;
    nodes.compress_as(n, std::array<int, 0>{});
  }
}

template bool joins_parts(const std::array<int, 3>&, const Nodes<2>&);
template bool joins_parts(const std::array<int, 4>&, const Nodes<3>&);
template std::vector<Facet<2>> smaller_parts_first(const std::vector<Facet<2>>&, const Nodes<2>&);
template std::vector<Facet<3>> smaller_parts_first(const std::vector<Facet<3>>&, const Nodes<3>&);
template void mix_joined(const Mesh<2>&, const std::vector<int>&, Nodes<2>&);
template void mix_joined(const Mesh<3>&, const std::vector<int>&, Nodes<3>&);
template void mix_absorbed(Nodes<2>&, const Mesh<2>&);
template void mix_absorbed(Nodes<3>&, const Mesh<3>&);

}  // namespace splashdown::fluid
