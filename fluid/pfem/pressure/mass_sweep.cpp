#include "fluid/pfem/pressure/mass_sweep.hpp"

#include <algorithm>

#include "fluid/pfem/linear/sparse_row.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

template <int d>
void MassSweep<d>::build(const std::vector<std::array<int, d + 1>>& cells, const NodeCells<d>& around,
                         std::span<const double> share, std::span<const double> per_mass,
                         std::span<const double> keeps) {
  const std::size_t nodes = keeps.size();
  own_.assign(keeps.begin(), keeps.end());
  start_.assign(nodes + 1, 0);
  constexpr std::size_t in_block = 1024;  // nodes
  std::vector<std::vector<SparseRow<double>::Entry>> blocks((nodes + in_block - 1) / in_block);
  PerThread<SparseRow<double>> rows([&] { return SparseRow<double>(nodes); });
  in_pieces(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
    auto& row = rows.local();
    for (std::size_t b = first; b < last; ++b)
      for (std::size_t i = b * in_block; i < std::min(nodes, (b + 1) * in_block); ++i) {
        row.clear();
        for (const auto [c, k] : around.around(i)) {
          const double weight = per_mass[i] * share[c];
          own_[i] -= weight;
          for (int j = 0; j <= d; ++j)
            if (j != k) row.add(cells[c][j], weight);
        }
        const auto entries = row.entries();
        blocks[b].insert(blocks[b].end(), entries.begin(), entries.end());
        start_[i + 1] = static_cast<int>(entries.size());
      }
  });
  for (std::size_t i = 0; i < nodes; ++i) start_[i + 1] += start_[i];
  node_.resize(static_cast<std::size_t>(start_[nodes]));
  weight_.resize(node_.size());
  in_pieces(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      auto to = static_cast<std::size_t>(start_[b * in_block]);
      for (const auto& e : blocks[b]) {
        node_[to] = e.column;
        weight_[to++] = e.value;
      }
    }
  });
}

template <int d>
void MassSweep<d>::operator()(std::span<const Vec<d>> u, std::vector<Vec<d>>& out) const {
  out.resize(u.size());
  in_parallel(u.size(), [&](std::size_t i) { out[i] = (*this)(i, u); });
}

template class MassSweep<2>;
template class MassSweep<3>;

}  // namespace splashdown::fluid
