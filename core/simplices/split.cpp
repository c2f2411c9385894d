#include "core/simplices/split.hpp"

#include <algorithm>

namespace splashdown {

SplitTriangles split(const Eigen::Matrix2Xd& nodes, std::span<const std::array<int, cell_nodes<2>>> cells) {
  constexpr std::array<std::array<int, 3>, 4> parts{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  SplitTriangles all;
  all.places.resize(static_cast<std::size_t>(nodes.cols()));
  std::vector<Vec<2>> added;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Eigen::Matrix<double, 2, cell_nodes<2>> x;
    for (int k = 0; k < cell_nodes<2>; ++k) {
      const int node = cells[c][static_cast<std::size_t>(k)];
      x.col(k) = nodes.col(node);
      all.places[static_cast<std::size_t>(node)] = {static_cast<int>(c), node_place<2>(k)};
    }
    for (const auto& part : parts) {
      std::array<int, cell_nodes<2>> cell{};
      for (std::size_t k = 0; k < 3; ++k) cell[k] = cells[c][static_cast<std::size_t>(part[k])];
      for (std::size_t e = 0; e < edge_count<2>; ++e) {
        const auto [i, j] = cell_edges[e];
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const int low = std::min(cell[a], cell[b]), high = std::max(cell[a], cell[b]);
        const auto [middle, is_new] = all.middles.try_emplace({low, high}, static_cast<int>(all.places.size()));
        if (is_new) {
          const Barycentric<2> at = 0.5 * (node_place<2>(part[a]) + node_place<2>(part[b]));
          added.push_back(x * shapes<2>(at));
          all.places.push_back({static_cast<int>(c), at});
        }
        cell[3 + e] = middle->second;
      }
      all.cells.push_back(cell);
    }
  }
  all.nodes.resize(2, static_cast<Eigen::Index>(all.places.size()));
  all.nodes.leftCols(nodes.cols()) = nodes;
  for (std::size_t k = 0; k < added.size(); ++k) all.nodes.col(nodes.cols() + static_cast<Eigen::Index>(k)) = added[k];
  return all;
}

}  // namespace splashdown
