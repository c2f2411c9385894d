#include "fluid/pressure/mass_sweep.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "fluid/parallel.hpp"

namespace splashdown::fluid {

template <int d>
void MassSweep<d>::build(const std::vector<std::array<int, d + 1>>& cells, const NodeCells<d>& around,
                         std::span<const double> share, std::span<const double> per_mass,
                         std::span<const double> keeps) {
  const std::size_t nodes = keeps.size();
  own_.assign(keeps.begin(), keeps.end());
  start_.assign(nodes + 1, 0);
  struct Entry {
    int node;
    double weight;
  };
  constexpr std::size_t in_block = 1024;  // nodes
  std::vector<std::vector<Entry>> blocks((nodes + in_block - 1) / in_block);
  tbb::enumerable_thread_specific<std::vector<std::size_t>> places([&] { return std::vector<std::size_t>(nodes, 0); });
  in_pieces(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
    auto& place_of = places.local();  // of a node's entry, if it has one in the present row
    for (std::size_t b = first; b < last; ++b)
      for (std::size_t i = b * in_block; i < std::min(nodes, (b + 1) * in_block); ++i) {
        auto& block = blocks[b];
        const std::size_t row = block.size();
        for (const auto [c, k] : around.around(i)) {
          const double weight = per_mass[i] * share[c];
          own_[i] -= weight;
          for (int j = 0; j <= d; ++j) {
            if (j == k) continue;
            const int n = cells[c][j];
            std::size_t& place = place_of[n];
            if (place < row || place >= block.size() || block[place].node != n) {
              place = block.size();
              block.push_back({n, 0});
            }
            block[place].weight += weight;
          }
        }
        start_[i + 1] = static_cast<int>(block.size() - row);
      }
  });
  for (std::size_t i = 0; i < nodes; ++i) start_[i + 1] += start_[i];
  node_.resize(static_cast<std::size_t>(start_[nodes]));
  weight_.resize(node_.size());
  in_pieces(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      auto to = static_cast<std::size_t>(start_[b * in_block]);
      for (const Entry& e : blocks[b]) {
        node_[to] = e.node;
        weight_[to++] = e.weight;
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
