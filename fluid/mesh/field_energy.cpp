#include "fluid/mesh/field_energy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Nodes whose volume has changed, in patches that hang together by cells.
template <int d>
class Patches {
 public:
  Patches(const Nodes<d>& nodes, const Mesh<d>& mesh, std::span<const double> recognised) : first_(nodes.size(), -1) {
    constexpr double roundoff = 1e-6;  // of sums of volumes
    for (std::size_t i = 0; i < first_.size(); ++i)
      if (!nodes.spray[i] && std::abs(recognised[i] - nodes.volume[i]) > roundoff * (recognised[i] + nodes.volume[i]))
        first_[i] = static_cast<int>(i);
    for (const auto& cell : mesh.cells) {
      int first = -1;
      for (int n : cell) {
        if (!has(n)) continue;
        const int other = find(n);
        if (first >= 0) first_[std::max(first, other)] = std::min(first, other);
        first = first < 0 ? other : std::min(first, other);
      }
    }
    for (std::size_t i = 0; i < first_.size(); ++i)
      if (has(static_cast<int>(i))) first_[i] = first_[first_[i]];  // of lower nodes they are known
  }

  bool has(int node) const { return first_[node] >= 0; }
  /// The patch, by its first node; -1: none.
  int of(int node) const { return first_[node]; }
  /// That the nodes of a cell are in; they are in one at most.
  int of_cell(const std::array<int, d + 1>& cell) const {
    const auto in = std::ranges::find_if(cell, [&](int n) { return has(n); });
    return in == cell.end() ? -1 : of(*in);
  }

 private:
  int find(int n) {
    while (first_[n] != n) n = first_[n] = first_[first_[n]];
    return n;
  }

  std::vector<int> first_;
};

/// A cell with nodes of a patch that has an excess.
struct ActiveCell {
  int cell, patch;
  double volume;
};

/// By how much velocities change in a whole exchange; zero of nodes in no patch.
template <int d>
void exchange(const Mesh<d>& mesh, const std::vector<Vec<d>>& v, const std::vector<ActiveCell>& cells,
              const Patches<d>& patches, std::span<const double> volumes, std::vector<Vec<d>>& change) {
  for (const auto& active : cells)
    for (int n : mesh.cells[active.cell]) change[n].setZero();
  for (const auto& active : cells) {
    const auto& cell = mesh.cells[active.cell];
    Vec<d> mean = Vec<d>::Zero();
    int count = 0;
    for (int n : cell)
      if (patches.has(n)) mean += v[n], ++count;
    mean /= count;
    for (int n : cell)
      if (patches.has(n) && volumes[n] > 0) change[n] += active.volume / ((d + 1) * volumes[n]) * (mean - v[n]);
  }
}

/// What each patch is to lose, at its first node: its share in what the patches of its part have gained, of what that has in excess.
template <int d>
std::vector<double> excess_of_patches(const Patches<d>& patches, const std::vector<double>& gain,
                                      const std::vector<double>& of_part, const std::vector<int>& part) {
  std::vector<double> excess(gain.size(), 0.0), gained(gain.size(), 0.0);
  for (std::size_t i = 0; i < gain.size(); ++i)
    if (const int patch = patches.of(static_cast<int>(i)); patch >= 0) excess[patch] += gain[i];
  for (std::size_t i = 0; i < gain.size(); ++i) gained[part[i]] += std::max(0.0, excess[i]);
  for (std::size_t i = 0; i < gain.size(); ++i)
    excess[i] = excess[i] > 0 ? excess[i] * std::max(0.0, of_part[part[i]]) / gained[part[i]] : 0.0;
  return excess;
}

/// Lets nodes of patches exchange momentum until they have lost their excess, or nothing more goes.
template <int d>
void take_out(std::vector<double> excess, const Patches<d>& patches, const Mesh<d>& mesh,
              std::span<const double> volumes, Nodes<d>& nodes) {
  constexpr int exchanges = 6;
  constexpr double left = 1e-6;  // of an excess
  const std::size_t count = nodes.size();
  std::vector<ActiveCell> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (const int patch = patches.of_cell(mesh.cells[c]); patch >= 0 && excess[patch] > 0)
      cells.push_back({static_cast<int>(c), patch, filled<d>(mesh.cells[c], nodes.x)});
  const std::vector<double> at_first = excess;
  std::vector<Vec<d>> change(count, Vec<d>::Zero());
  std::vector<double> linear(count), square(count), theta(count);  // of patches
  for (int k = 0; k < exchanges && !cells.empty(); ++k) {
    exchange<d>(mesh, nodes.v, cells, patches, volumes, change);
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
      if (const int patch = patches.of(static_cast<int>(i)); patch >= 0 && theta[patch] > 0)
        nodes.v[i] += theta[patch] * change[i];
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
  const Patches<d> patches(nodes, mesh, recognised);
  take_out<d>(excess_of_patches(patches, gain, of_part, free.part()), patches, mesh, volumes, nodes);
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
