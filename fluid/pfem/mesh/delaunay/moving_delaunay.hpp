// Delaunay triangulation of nodes that move a little from step to step.
//
// Of the triangulation that was, nearly all cells are Delaunay after a step too. Exact predicates find those that are
// not: a cell turned over, a node in the circumsphere of the cell beyond a facet, a node gone. In 2D edges between
// positive cells are flipped (Lawson 1977), which mends most. Patches of cells around what is left are given up, and grow until
// the Delaunay triangulation of their nodes alone holds all facets of their rim; its cells within the rim take their place.
// Then new nodes are located and added likewise. Points far away, one more than dimensions, are the hull, which never
// changes: cells that all are positive then cover it once, and with all facets locally Delaunay they are the Delaunay
// triangulation (Delaunay 1934). Where nodes are in special position CGAL's symbolic perturbation leaves no choice. So the
// result has the bits of a triangulation from nothing, whatever came before. It is made from nothing where too much has
// changed. What is kept for the next call knows nothing of facets.
//
// O(n) predicates on all threads, O(k) for k flips and O(k) for k nodes in patches. Cf. Guibas and Russel (2004), who compare
// ways of updating Delaunay triangulations.
#pragma once

#include "fluid/pfem/mesh/delaunay/delaunay.hpp"

namespace splashdown::fluid {

/// The last triangulation, from which the next one is made.
template <int d>
class MovingDelaunay {
 public:
  /// delaunay(points, facets), with hubs (hubs.hpp) among them. `before`: number of each point in the last call, -1 if it is new.
  Delaunay<d> follow(std::span<const Vec<d>> points, std::span<const int> before, const std::vector<Facet<d>>& facets,
                     std::span<const Vec<d>> hubs = {});
  /// Calls that were answered without a triangulation from nothing.
  int followed() const { return followed_; }

 private:
  ClosedDelaunay<d> last_;
  std::size_t points_ = 0, hubs_ = 0;
  int followed_ = 0;
};

}  // namespace splashdown::fluid
