// Quadratic simplices divided, triangles into four and tetrahedra into eight. Parts keep the shape of the cell that they lie in,
// a curved one as well: what is quadratic on the cells before is so on those after. Neighbours fit.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/simplices/quadratic.hpp"

namespace splashdown {

/// Parts of a cell: 4 and 8.
template <int d>
inline constexpr int part_count = 1 << d;

/// Corners of parts, by nodes of the cell. The inside of a tetrahedron is cut around the line between the middles 6 and 9.
template <int d>
constexpr std::array<std::array<int, d + 1>, part_count<d>> cell_parts() {
  if constexpr (d == 2)
    return {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  else
    return {{{0, 4, 6, 7},
             {4, 1, 5, 9},
             {6, 5, 2, 8},
             {7, 9, 8, 3},
             {6, 9, 4, 5},
             {6, 9, 5, 8},
             {6, 9, 8, 7},
             {6, 9, 7, 4}}};
}

/// Cells after, and where they lie before.
template <int d>
struct SplitCells {
  /// A point of a cell before.
  struct At {
    int cell;           ///< its number
    Barycentric<d> at;  ///< where in it
  };
  /// Those before keep their numbers and are the corners [m].
  Eigen::Matrix<double, d, Eigen::Dynamic> nodes;
  std::vector<std::array<int, cell_nodes<d>>> cells;  ///< `part_count` one after the other for each cell
  std::vector<At> places;                             ///< of nodes
  std::map<std::array<int, 2>, int> middles;          ///< the node between two corners, the lower number first

  /// The node in the middle of an edge; throws std::out_of_range for others.
  int middle(int a, int b) const { return middles.at(a < b ? std::array{a, b} : std::array{b, a}); }
};

/// Divides all cells.
template <int d>
SplitCells<d> split(const Eigen::Matrix<double, d, Eigen::Dynamic>& nodes,
                    std::span<const std::array<int, cell_nodes<d>>> cells);

/// The part of a cell that holds a point of it, and where in the part.
template <int d>
typename SplitCells<d>::At in_part(const Barycentric<d>& at);

extern template SplitCells<2> split<2>(const Eigen::Matrix2Xd&, std::span<const std::array<int, cell_nodes<2>>>);
extern template SplitCells<3> split<3>(const Eigen::Matrix3Xd&, std::span<const std::array<int, cell_nodes<3>>>);
extern template SplitCells<2>::At in_part<2>(const Barycentric<2>&);
extern template SplitCells<3>::At in_part<3>(const Barycentric<3>&);

}  // namespace splashdown
