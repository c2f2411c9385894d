// How far cells are from what they were made as. A cell's affine part maps its corners as made to those of now, x = F X + c:
//
//   quality = min(det / det as made, 2 det F / |F|^2)
//
// in (0, 1] of cells that shrink or are sheared, 1 of those that are moved, turned and grow alike in all directions. The first is
// taken at corners and at points of the rule, curved cells against themselves.
#pragma once

#include <vector>

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// Of a mesh as it was made. Keeps its numbers, no reference.
class MeshQuality {
 public:
  /// As it is.
  explicit MeshQuality(const FlowMesh& mesh);
  /// The worst cell's, with nodes there.
  double least(const Nodes& x) const;

 private:
  std::vector<Cell> cells_;
  std::vector<Mat<2>> inverse_;  // of each cell's edges from its first corner
  std::vector<double> made_;     // least determinant
};

/// The least determinant of a cell over that in its middle: 1 of straight cells, -1 of those that are folded in their middle.
std::vector<double> evenness(const FlowMesh& mesh);

}  // namespace splashdown::ale
