#include "core/simplices/split.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace splashdown {
template <int d>
SplitCells<d> split(const Eigen::Matrix<double, d, Eigen::Dynamic>& nodes,
                    std::span<const std::array<int, cell_nodes<d>>> cells) {
  SplitCells<d> all;
  all.places.resize(static_cast<std::size_t>(nodes.cols()));
  std::vector<Vec<d>> added;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Eigen::Matrix<double, d, cell_nodes<d>> x;
    for (int k = 0; k < cell_nodes<d>; ++k) {
      const int node = cells[c][static_cast<std::size_t>(k)];
      x.col(k) = nodes.col(node);
      all.places[static_cast<std::size_t>(node)] = {static_cast<int>(c), node_place<d>(k)};
    }
    for (const auto& part : cell_parts<d>()) {
      std::array<int, cell_nodes<d>> cell{};
      for (std::size_t k = 0; k <= d; ++k) cell[k] = cells[c][static_cast<std::size_t>(part[k])];
      for (std::size_t e = 0; e < edge_count<d>; ++e) {
        const auto [i, j] = cell_edges[e];
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const int low = std::min(cell[a], cell[b]), high = std::max(cell[a], cell[b]);
        const auto [middle, is_new] = all.middles.try_emplace({low, high}, static_cast<int>(all.places.size()));
        if (is_new) {
          const Barycentric<d> at = 0.5 * (node_place<d>(part[a]) + node_place<d>(part[b]));
          added.push_back(x * shapes<d>(at));
          all.places.push_back({static_cast<int>(c), at});
        }
        cell[d + 1 + e] = middle->second;
      }
      all.cells.push_back(cell);
    }
  }
  all.nodes.resize(d, static_cast<Eigen::Index>(all.places.size()));
  all.nodes.leftCols(nodes.cols()) = nodes;
  for (std::size_t k = 0; k < added.size(); ++k) all.nodes.col(nodes.cols() + static_cast<Eigen::Index>(k)) = added[k];
  return all;
}

template <int d>
typename SplitCells<d>::At in_part(const Barycentric<d>& at) {
  typename SplitCells<d>::At best{0, at};
  double most = -1e300;
  int number = 0;
  for (const auto& part : cell_parts<d>()) {
    Eigen::Matrix<double, d + 1, d + 1> corners;
    for (int k = 0; k <= d; ++k) corners.col(k) = node_place<d>(part[static_cast<std::size_t>(k)]);
    const Barycentric<d> own = corners.inverse() * at;
    if (own.minCoeff() > most) {
      most = own.minCoeff();
      best = {number, own};
    }
    ++number;
  }
  return best;
}

template SplitCells<2> split<2>(const Eigen::Matrix2Xd&, std::span<const std::array<int, cell_nodes<2>>>);
template SplitCells<3> split<3>(const Eigen::Matrix3Xd&, std::span<const std::array<int, cell_nodes<3>>>);
template SplitCells<2>::At in_part<2>(const Barycentric<2>&);
template SplitCells<3>::At in_part<3>(const Barycentric<3>&);

}  // namespace splashdown
