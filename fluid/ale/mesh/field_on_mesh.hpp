// A field on a mesh, anywhere in it: which cell a point lies in, and where in it.
#pragma once

#include <array>
#include <vector>

#include "core/simplices/piece_finder.hpp"
#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// Places in a mesh. Keeps a reference to it.
class PlacesInMesh {
 public:
  /// `x`: where its nodes are [m].
  PlacesInMesh(const FlowMesh& mesh, const Nodes& x);
  PlacesInMesh(const PlacesInMesh&) = delete;
  PlacesInMesh& operator=(const PlacesInMesh&) = delete;
  /// A place in a cell.
  struct Place {
    const Cell* cell;
    Barycentric<2> at;
  };
  /// Of a point [m]. Beyond the mesh: of the nearest cell, a fifth of it outside at most.
  Place find(const Vec<2>& point) const;
  /// A quadratic field there, by its nodes.
  Vec<2> quadratic(const Nodes& values, const Vec<2>& point) const;
  /// A linear one, by its corners.
  double linear(const Eigen::VectorXd& values, const Vec<2>& point) const;

 private:
  PieceFinder::Place nearest(const Vec<2>& point) const;

  const FlowMesh& mesh_;
  std::vector<Vec<2>> points_;
  std::vector<std::array<int, 3>> pieces_;
  PieceFinder finder_;
};

}  // namespace splashdown::ale
