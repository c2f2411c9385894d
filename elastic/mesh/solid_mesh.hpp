// A solid as quadratic simplices at rest, and what may be wrong with one.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/simplices/split.hpp"

/// Solids that deform: meshes, laws, equations of motion, modes. SI; two-dimensional quantities are per metre of depth.
namespace splashdown::elastic {

/// Corner numbers of straight simplices.
template <int d>
using Simplices = std::vector<std::array<int, d + 1>>;
/// Points, a column each [m].
template <int d>
using Points = Eigen::Matrix<double, d, Eigen::Dynamic>;

/// Why a mesh is no solid: what is wrong, and what cures it.
struct MeshError : std::runtime_error {
  /// `what` is a clause that may follow the name of a file.
  MeshError(const std::string& what, std::string cure_) : std::runtime_error(what), cure(std::move(cure_)) {}
  std::string cure;  ///< a sentence
};

/// Nodes and cells of a body at rest, in its own frame [m].
template <int d>
struct SolidMesh {
  Points<d> nodes;
  std::vector<std::array<int, cell_nodes<d>>> cells;    ///< positively oriented
  std::vector<std::array<int, facet_nodes<d>>> facets;  ///< of the boundary; normals by the right hand point out
  /// Number of nodes.
  int size() const { return static_cast<int>(nodes.cols()); }
};

/// Straight simplices with a node in the middle of each edge. Corners that no simplex has are left out.
template <int d>
SolidMesh<d> quadratic_mesh(const Points<d>& corners, const Simplices<d>& simplices);

/// The mesh of these cells: nodes of no cell are dropped, cells that are wound the other way are turned, the boundary is
/// found. Throws MeshError unless it is one solid: each facet between two cells at most, cells connected through facets, no
/// cell folded or flat.
template <int d>
SolidMesh<d> solid_mesh(const Points<d>& nodes, std::vector<std::array<int, cell_nodes<d>>> cells);

/// A point in a cell.
template <int d>
struct Place {
  int cell = 0;
  Barycentric<d> at = Barycentric<d>::Zero();
};

/// The same point where each cell is divided (core/simplices/split.hpp).
template <int d>
Place<d> in_divided(const Place<d>& place) {
  const auto part = in_part<d>(place.at);
  return {part_count<d> * place.cell + part.cell, part.at};
}

/// The cell where a point of the body at rest lies, within `near` of its surface [m]; nothing: it is outside.
template <int d>
std::optional<Place<d>> locate(const SolidMesh<d>& mesh, const Vec<d>& point, double near);

/// Shape of a straight simplex: d (d! V)^(2/d) (d + 1)/sum of its squared edges over that of a regular one (Liu, Joe 1994);
/// 1: it is regular, 0: flat. `cell` begins with its corners.
template <int d, std::size_t n>
double mean_ratio(const Points<d>& nodes, const std::array<int, n>& cell) {
  Mat<d> sides;
  for (int i = 0; i < d; ++i) sides.col(i) = nodes.col(cell[static_cast<std::size_t>(i) + 1]) - nodes.col(cell[0]);
  double squares = sides.squaredNorm();
  for (int i = 0; i < d; ++i)
    for (int k = 0; k < i; ++k) squares += (sides.col(i) - sides.col(k)).squaredNorm();
  const double regular = d == 2 ? 2 * std::sqrt(3.) : 6 * std::cbrt(4.);  // sum of squares over |det|^(2/d)
  return regular * std::pow(std::abs(sides.determinant()), 2. / d) / squares;
}
/// The least of all cells, by their corners.
template <int d>
double least_quality(const SolidMesh<d>& mesh);
/// Longest straight edge of all cells [m].
template <int d>
double longest_edge(const SolidMesh<d>& mesh);

/// Longest edge of the box around the nodes [m].
template <int d>
double extent(const SolidMesh<d>& mesh) {
  return (mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff()).maxCoeff();
}

}  // namespace splashdown::elastic
