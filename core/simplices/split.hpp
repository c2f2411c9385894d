// Quadratic simplices divided into 2^d each: triangles into four, tetrahedra into eight (Bey 1995, along one diagonal of the
// octahedron that is left inside). Parts keep the shape of the cell that they lie in, a curved one as well: what is quadratic on
// the cells before is so on those after. Neighbours fit.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/simplices/quadratic.hpp"

namespace splashdown {

/// Cells after, and where they lie before.
template <int d>
struct SplitCells {
  /// A point of a cell before.
  struct At {
    int cell;           ///< its number
    Barycentric<d> at;  ///< where in it
  };
  Eigen::Matrix<double, d, Eigen::Dynamic> nodes;     ///< those before keep their numbers and are the corners [m]
  std::vector<std::array<int, cell_nodes<d>>> cells;  ///< 2^d one after the other for each cell
  std::vector<At> places;                             ///< of nodes
  std::map<std::array<int, 2>, int> middles;          ///< the node between two corners, the lower number first

  /// The node in the middle of an edge; throws std::out_of_range for others.
  int middle(int a, int b) const { return middles.at(a < b ? std::array{a, b} : std::array{b, a}); }
};

/// Divides all cells.
template <int d>
SplitCells<d> split(const Eigen::Matrix<double, d, Eigen::Dynamic>& nodes,
                    std::span<const std::array<int, cell_nodes<d>>> cells);

extern template SplitCells<2> split<2>(const Eigen::Matrix2Xd&, std::span<const std::array<int, cell_nodes<2>>>);
extern template SplitCells<3> split<3>(const Eigen::Matrix3Xd&, std::span<const std::array<int, cell_nodes<3>>>);

}  // namespace splashdown
