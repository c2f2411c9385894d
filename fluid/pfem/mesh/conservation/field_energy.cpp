#include "fluid/pfem/mesh/conservation/field_energy.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/pfem/mesh/parts.hpp"

namespace splashdown::fluid {
namespace {

/// int u_h . w_h dx over a cell of this volume.
template <int d>
double product(const std::array<int, d + 1>& cell, double volume, const std::vector<Vec<d>>& u,
               const std::vector<Vec<d>>& w) {
  Vec<d> all_u = Vec<d>::Zero(), all_w = Vec<d>::Zero();
  double each = 0;
  for (int n : cell) all_u += u[n], all_w += w[n], each += u[n].dot(w[n]);
  return volume / ((d + 1) * (d + 2)) * (each + all_u.dot(all_w));
}

/// Cells that have turned over hold no energy.
template <int d>
double filled(const std::array<int, d + 1>& cell, const std::vector<Vec<d>>& x) {
  return std::max(0.0, volume<d>(corners(x, cell)));
}

/// The part of an exchange after which an excess is gone that changes by `linear` theta + `square` theta^2 with it.
double part_of_exchange(double excess, double linear, double square) {
  if (!(linear < 0)) return 0;
  const double discriminant = linear * linear - 4 * square * excess;
  return std::min(1.0, discriminant > 0 ? 2 * excess / (std::sqrt(discriminant) - linear) : -linear / (2 * square));
}

/// Nodes whose volume has changed, as far as they hang together by cells: of each the first one of its patch, -1: in none.
template <int d>
std::vector<int> patches_of(const Nodes<d>& nodes, const Mesh<d>& mesh, std::span<const double> recognised) {
  constexpr double roundoff = 1e-6;  // of sums of volumes
  std::vector<char> changed(nodes.size());
  for (std::size_t i = 0; i < changed.size(); ++i)
    changed[i] =
        !nodes.spray[i] && std::abs(recognised[i] - nodes.volume[i]) > roundoff * (recognised[i] + nodes.volume[i]);
  return parts_of(mesh, changed);
}

/// A cell with nodes of a patch that has an excess.
struct ActiveCell {
  int cell, patch;
  double volume;
};

/// By how much velocities change in a whole exchange; zero of nodes in no patch.
template <int d>
void exchange(const Mesh<d>& mesh, const std::vector<Vec<d>>& v, const std::vector<ActiveCell>& cells,
              const std::vector<int>& patch, std::span<const double> volumes, std::vector<Vec<d>>& change) {
  for (const auto& active : cells)
    for (int n : mesh.cells[active.cell]) change[n].setZero();
  for (const auto& active : cells) {
    const auto& cell = mesh.cells[active.cell];
    Vec<d> mean = Vec<d>::Zero();
    int count = 0;
    for (int n : cell)
      if (patch[n] >= 0) mean += v[n], ++count;
    mean /= count;
    for (int n : cell)
      if (patch[n] >= 0 && volumes[n] > 0) change[n] += active.volume / ((d + 1) * volumes[n]) * (mean - v[n]);
  }
}

/// What each patch is to lose, at its first node: its share in what the patches of its part have gained, of what that has in excess.
std::vector<double> excess_of_patches(const std::vector<int>& patch, const std::vector<double>& gain,
                                      const std::vector<double>& of_part, const std::vector<int>& part) {
  std::vector<double> excess(gain.size(), 0.0), gained(gain.size(), 0.0);
  for (std::size_t i = 0; i < gain.size(); ++i)
    if (patch[i] >= 0) excess[patch[i]] += gain[i];
  for (std::size_t i = 0; i < gain.size(); ++i) gained[part[i]] += std::max(0.0, excess[i]);
  for (std::size_t i = 0; i < gain.size(); ++i)
    excess[i] = excess[i] > 0 ? excess[i] * std::max(0.0, of_part[part[i]]) / gained[part[i]] : 0.0;
  return excess;
}

/// Lets nodes of patches exchange momentum until they have lost their excess, or nothing more goes.
template <int d>
void take_out(std::vector<double> excess, const std::vector<int>& patch, const Mesh<d>& mesh,
              std::span<const double> volumes, Nodes<d>& nodes) {
  constexpr int exchanges = 6;
  constexpr double left = 1e-6;  // of an excess
  const std::size_t count = nodes.size();
  std::vector<ActiveCell> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& cell = mesh.cells[c];  // its nodes are in one patch at most
    const auto in = std::ranges::find_if(cell, [&](int n) { return patch[n] >= 0; });
    if (in != cell.end() && excess[patch[*in]] > 0)
      cells.push_back({static_cast<int>(c), patch[*in], filled<d>(cell, nodes.x)});
  }
  const std::vector<double> at_first = excess;
  std::vector<Vec<d>> change(count, Vec<d>::Zero());
  std::vector<double> linear(count), square(count), theta(count);  // of patches
  for (int k = 0; k < exchanges && !cells.empty(); ++k) {
    exchange<d>(mesh, nodes.v, cells, patch, volumes, change);
    for (const auto& active : cells) linear[active.patch] = square[active.patch] = 0;
    for (const auto& active : cells) {
      const auto& cell = mesh.cells[active.cell];
      linear[active.patch] += product<d>(cell, active.volume, nodes.v, change);
      square[active.patch] += 0.5 * product<d>(cell, active.volume, change, change);
    }
    for (std::size_t p = 0; p < count; ++p) {
      theta[p] = excess[p] > 0 ? part_of_exchange(excess[p], linear[p], square[p]) : 0;
      excess[p] += theta[p] * (linear[p] + theta[p] * square[p]);
    }
    for (std::size_t i = 0; i < count; ++i)
      if (patch[i] >= 0 && theta[patch[i]] > 0) nodes.v[i] += theta[patch[i]] * change[i];
    for (std::size_t p = 0; p < count; ++p)
      if (theta[p] == 0 || excess[p] <= left * at_first[p]) excess[p] = 0;
    std::erase_if(cells, [&](const ActiveCell& active) { return excess[active.patch] == 0; });
  }
}

}  // namespace

template <int d>
double cell_energy(const std::array<int, d + 1>& cell, const std::vector<Vec<d>>& x, const std::vector<Vec<d>>& v) {
  return 0.5 * product<d>(cell, filled<d>(cell, x), v, v);
}

template <int d>
std::vector<double> field_energies(const Mesh<d>& mesh, const Nodes<d>& nodes) {
  std::vector<double> of_cell(mesh.cells.size()), of_node(nodes.size(), 0.0);
  in_parallel(of_cell.size(), [&](std::size_t c) { of_cell[c] = cell_energy<d>(mesh.cells[c], nodes.x, nodes.v); });
  for (std::size_t c = 0; c < of_cell.size(); ++c)
    for (int n : mesh.cells[c]) of_node[n] += of_cell[c] / (d + 1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.spray[i]) of_node[i] = nodes.carried(i).energy;
  return of_node;
}

template <int d>
void limit_field_energy(Nodes<d>& nodes, const Mesh<d>& mesh, const FreeWater<d>& free,
                        std::span<const double> recognised, std::span<const double> volumes) {
  std::vector<double> gain = field_energies(mesh, nodes), of_part(nodes.size(), 0.0);
  for (std::size_t i = 0; i < gain.size(); ++i) {
    gain[i] -= nodes.field_energy[i];
    if (!nodes.spray[i] && !free.has(i)) of_part[free.part()[i]] += gain[i];
  }
  if (std::ranges::none_of(of_part, [](double energy) { return energy > 0; })) return;
  const std::vector<int> patch = patches_of(nodes, mesh, recognised);
  take_out<d>(excess_of_patches(patch, gain, of_part, free.part()), patch, mesh, volumes, nodes);
}

template double cell_energy<2>(const std::array<int, 3>&, const std::vector<Vec<2>>&, const std::vector<Vec<2>>&);
template double cell_energy<3>(const std::array<int, 4>&, const std::vector<Vec<3>>&, const std::vector<Vec<3>>&);
template std::vector<double> field_energies(const Mesh<2>&, const Nodes<2>&);
template std::vector<double> field_energies(const Mesh<3>&, const Nodes<3>&);
template void limit_field_energy(Nodes<2>&, const Mesh<2>&, const FreeWater<2>&, std::span<const double>,
                                 std::span<const double>);
template void limit_field_energy(Nodes<3>&, const Mesh<3>&, const FreeWater<3>&, std::span<const double>,
                                 std::span<const double>);

}  // namespace splashdown::fluid
