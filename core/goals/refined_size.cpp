#include "core/goals/refined_size.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace splashdown {

std::function<double(const Vec<2>&)> refined_size(const Eigen::Matrix2Xd& nodes,
                                                  std::span<const std::array<int, cell_nodes<2>>> cells,
                                                  std::span<const double> by_cell, double share) {
  if (by_cell.size() != cells.size()) throw std::invalid_argument("shares of the error must be of the mesh's cells");
  std::vector<std::size_t> order(by_cell.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t c) { return by_cell[c]; });
  std::vector<char> is_refined(by_cell.size(), 0);
  double left = share * std::accumulate(by_cell.begin(), by_cell.end(), 0.);
  for (std::size_t k = 0; k < order.size() && left > 0; left -= by_cell[order[k++]]) is_refined[order[k]] = 1;
  struct Sizes {
    std::vector<Vec<2>> points;
    std::vector<std::array<int, 3>> cells;
    std::vector<double> size;
    PieceFinder finder;
  };
  auto sizes = std::make_shared<Sizes>();
  for (Eigen::Index a = 0; a < nodes.cols(); ++a) sizes->points.emplace_back(nodes.col(a));
  // New meshes have edges a little below what is allowed.
  constexpr double kept = 1.2;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& cell = cells[c];
    sizes->cells.push_back({cell[0], cell[1], cell[2]});
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (nodes.col(cell[k]) - nodes.col(cell[(k + 1) % 3])).norm());
    sizes->size.push_back(longest * (is_refined[c] ? 0.5 : kept));
  }
  sizes->finder.place(sizes->cells, sizes->points);
  return [sizes](const Vec<2>& x) {
    const auto found = sizes->finder.find(x);
    return found ? sizes->size[found->piece] : std::numeric_limits<double>::infinity();
  };
}

void JointShares::add(std::span<const double> by_cell) {
  const double sum = std::accumulate(by_cell.begin(), by_cell.end(), 0.);
  for (std::size_t c = 0; c < by_cell.size() && sum > 0; ++c) all_[c] += by_cell[c] / sum;
}

}  // namespace splashdown
