// Hollows of a hull: what of it stays dry below the water level because the water would have to come over a rim first.
//
// Water that rises around the hull wets what lies below it and is joined to the outside below it. The part of the surface below a
// level falls into components. One whose lowest point has the solid below it and room above lies in a hollow, all others in the
// water outside; a hollow is flooded at the level where its component joins one of these: the height of its rim. Components
// of all levels come from one pass over the vertices in ascending order (Carr, Snoeyink, Axen 2003), exact for polygons and
// triangle meshes. Assumed: hollows are empty at first, air leaves freely, and what hangs into a hollow is joined to it below
// the rim. Cost: a look at the vertices where the surface is not convex; n log n if there is a hollow. Internal to the
// rigid-body room.
#pragma once

#include <vector>

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// Finds rims and bottoms of a hull's hollows, in any attitude.
template <int d>
class Hollows {
 public:
  /// Of a closed surface with outward normals, which is kept by reference.
  explicit Hollows(const Surface<d>& surface);
  bool possible() const { return !concave_.empty(); }  ///< in some attitude
  /// Of the hull in an attitude, its turned vertices given, d x n: the height of the water outside [m] from which on it
  /// reaches each vertex that it covers; the least double for vertices outside hollows. Empty: there is no hollow.
  std::vector<double> rims(const Eigen::Matrix<double, d, Eigen::Dynamic>& turned) const;
  /// Lowest vertices of hollows that open upward, shallow ones too.
  std::vector<int> bottoms(const Eigen::Matrix<double, d, Eigen::Dynamic>& turned) const;

 private:
  using Corners = Eigen::Matrix<double, d, Eigen::Dynamic>;
  bool is_bottom(const Corners& turned, int vertex) const;
  bool opens_upward(const Corners& turned, int vertex) const;

  const Surface<d>* surface_;
  std::vector<std::vector<int>> neighbours_, facets_;  // of vertices
  std::vector<int> concave_;                           // vertices that may be the bottom of a hollow
};

extern template class Hollows<2>;
extern template class Hollows<3>;

}  // namespace splashdown::rigid
