// How nodes between walls follow them: displacements or velocities d of walls, extended into the fluid by
//
//   laplace:     div(s grad d) = 0,   s = (mean area / area of the cell)^stiffening
//   biharmonic:  div grad (div grad d) = 0,   no slope of d across walls and sides
//
// on the mesh as it was made. With the first, small cells, which lie at walls, move as if they were stiff (Masud & Hughes 1997):
// what walls do is left to large cells, which narrow gaps squeeze. The second carries cells along with a wall and spreads the
// rest over the whole gap (Helenbrook 2003). Corners of cells follow by linear elements, middles of edges follow their ends:
// straight edges stay straight. The map is linear and knows no history: a wall that comes back brings every node back.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// What is solved between walls.
enum class ExtensionLaw { laplace, biharmonic };

/// The map from walls to all nodes. Sides of the box stay.
class Extension {
 public:
  /// Factors the equation. Keeps no reference.
  explicit Extension(const FlowMesh& mesh, ExtensionLaw law = ExtensionLaw::laplace);
  /// Nodes whose values are given, walls' and sides'; the others follow.
  const std::vector<char>& is_given() const { return is_given_; }
  /// Fills in all nodes that are not given.
  void extend(Nodes& values) const;

 private:
  void find_followers(const FlowMesh& mesh);

  std::vector<char> is_given_;
  std::vector<int> free_;                    // number of each corner among those that follow, -1: given
  std::vector<std::array<int, 3>> middles_;  // that follow: a node and the ends of its edge
  Eigen::SparseMatrix<double> coupling_;     // of those that follow with those that are given
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace splashdown::ale
