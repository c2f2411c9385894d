#include "core/simplices/split.hpp"

#include <Eigen/LU>
#include <utility>

namespace splashdown {
namespace {

/// Corners of parts, in nodes of the cell.
template <int d>
constexpr auto part_corners() {
  if constexpr (d == 2)
    return std::array<std::array<int, 3>, 4>{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  else
    return std::array<std::array<int, 4>, 8>{{{0, 4, 6, 7},
                                              {4, 1, 5, 9},
                                              {6, 5, 2, 8},
                                              {7, 9, 8, 3},
                                              {6, 9, 4, 5},
                                              {6, 9, 5, 8},
                                              {6, 9, 8, 7},
                                              {6, 9, 7, 4}}};
}

/// Of a node in its cell.
template <int d>
Barycentric<d> place_of(int node) {
  Barycentric<d> at = Barycentric<d>::Zero();
  if (node <= d)
    at[node] = 1;
  else
    for (const int corner : cell_edges[static_cast<std::size_t>(node - d - 1)]) at[corner] = 0.5;
  return at;
}

/// Whether corners, in barycentric coordinates of the cell, are wound as the cell's own.
template <int d>
bool is_wound_alike(const std::array<int, d + 1>& corners) {
  Eigen::Matrix<double, d + 1, d + 1> all;
  for (int k = 0; k <= d; ++k) all.col(k) = place_of<d>(corners[static_cast<std::size_t>(k)]);
  return all.determinant() > 0;
}

}  // namespace

template <int d>
SplitCells<d> split(const Eigen::Matrix<double, d, Eigen::Dynamic>& nodes,
                    std::span<const std::array<int, cell_nodes<d>>> cells) {
  SplitCells<d> all;
  all.places.resize(static_cast<std::size_t>(nodes.cols()));
  std::vector<Vec<d>> added;
  auto parts = part_corners<d>();
  for (auto& part : parts)
    if (!is_wound_alike<d>(part)) std::swap(part[0], part[1]);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Eigen::Matrix<double, d, cell_nodes<d>> x;
    for (int k = 0; k < cell_nodes<d>; ++k) {
      const int node = cells[c][static_cast<std::size_t>(k)];
      x.col(k) = nodes.col(node);
      all.places[static_cast<std::size_t>(node)] = {static_cast<int>(c), place_of<d>(k)};
    }
    for (const auto& part : parts) {
      std::array<int, cell_nodes<d>> cell{};
      for (std::size_t k = 0; k <= d; ++k) cell[k] = cells[c][static_cast<std::size_t>(part[k])];
      for (std::size_t e = 0; e < edge_count<d>; ++e) {
        const auto [i, j] = cell_edges[e];
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const int low = std::min(cell[a], cell[b]), high = std::max(cell[a], cell[b]);
        const auto [middle, is_new] = all.middles.try_emplace({low, high}, static_cast<int>(all.places.size()));
        if (is_new) {
          const Barycentric<d> at = 0.5 * (place_of<d>(part[a]) + place_of<d>(part[b]));
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

template SplitCells<2> split<2>(const Eigen::Matrix2Xd&, std::span<const std::array<int, cell_nodes<2>>>);
template SplitCells<3> split<3>(const Eigen::Matrix3Xd&, std::span<const std::array<int, cell_nodes<3>>>);

}  // namespace splashdown
