// Cells of a Delaunay triangulation whose points have moved, for the sources of this folder alone.
#pragma once

#include <algorithm>
#include <compare>
#include <unordered_map>
#include <vector>

#include "fluid/pfem/mesh/delaunay/delaunay.hpp"
#include "fluid/pfem/mesh/delaunay/triangulation.hpp"

namespace splashdown::fluid {

/// A facet, by a cell and the corner opposite to it.
struct FacetAt {
  static constexpr int whole_cell = -1;
  int cell, corner;  ///< the corner opposite, or `whole_cell`
  /// By cell, then by corner.
  auto operator<=>(const FacetAt&) const = default;
};

/// A triangulation whose points have moved: cells may have turned over, and points be gone (negative). Its hull, the points far
/// away, stays as it is. (Where the hull is the nodes' own, patches beside each other may fold it, and no local test tells.)
template <int d>
class MovedCells {
 public:
  /// Numbers of the corners.
  using Cell = std::array<int, d + 1>;

  /// `points`: where they are now [m]; `mesh` is changed in place and must live longer.
  MovedCells(ClosedDelaunay<d>& mesh, std::span<const Vec<d>> points);

  ClosedDelaunay<d>& mesh;
  const int infinity;                                   ///< number of the vertex there
  std::vector<typename Cgal<d>::Point> at;              ///< points
  std::unordered_map<int, std::vector<int>> to_insert;  ///< new points by the cell that they lie in

  /// Whether the vertex at infinity is no corner.
  bool finite(const Cell& cell) const { return std::find(cell.begin(), cell.end(), infinity) == cell.end(); }
  /// Whether a corner is gone (negative).
  static bool lost_a_corner(const Cell& cell);
  CGAL::Orientation orientation(const Cell& cell) const;  ///< of a finite one
  /// Whether a finite cell is positively oriented, by exact predicates.
  bool positive(const Cell& cell) const { return orientation(cell) == CGAL::POSITIVE; }
  /// The point lies in the circumsphere of a positive cell.
  bool in_conflict(const Cell& cell, int point) const;
  /// No conflict across the facet of a positive cell. True where the cell beyond has lost a corner or is at infinity.
  bool locally_delaunay(const FacetAt& f) const;
  /// Cell and corner on the other side.
  FacetAt beyond(const FacetAt& f) const;
  /// Corners of the facet in the order that tells its sides apart: the other cell has them in another order.
  static std::array<int, d> facet_of(const Cell& cell, int corner);
  /// Walks towards a point, in a triangulation that is Delaunay: the cell that holds it.
  int locate(int point, int start) const;

 private:
  std::array<const typename Cgal<d>::Point*, d + 1> points_of(const Cell& cell) const;

  Predicates<d> is_;
};

}  // namespace splashdown::fluid
