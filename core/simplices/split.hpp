// Quadratic triangles divided into four each. Parts keep the shape of the cell that they lie in, a curved one as well: what is
// quadratic on the cells before is so on those after. Neighbours fit.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/simplices/quadratic.hpp"

namespace splashdown {

/// Cells after, and where they lie before.
struct SplitTriangles {
  /// A point of a cell before.
  struct At {
    int cell;           ///< its number
    Barycentric<2> at;  ///< where in it
  };
  Eigen::Matrix2Xd nodes;                             ///< those before keep their numbers and are the corners [m]
  std::vector<std::array<int, cell_nodes<2>>> cells;  ///< four one after the other for each cell
  std::vector<At> places;                             ///< of nodes
  std::map<std::array<int, 2>, int> middles;          ///< the node between two corners, the lower number first

  /// The node in the middle of an edge; throws std::out_of_range for others.
  int middle(int a, int b) const { return middles.at(a < b ? std::array{a, b} : std::array{b, a}); }
};

/// Divides all cells.
SplitTriangles split(const Eigen::Matrix2Xd& nodes, std::span<const std::array<int, cell_nodes<2>>> cells);

}  // namespace splashdown
