// Flips of edges in 2D, for the sources of this folder alone.
#pragma once

#include <optional>
#include <unordered_set>

#include "fluid/pfem/mesh/delaunay/moved_cells.hpp"

namespace splashdown::fluid {

/// Flips of the edge between two positive cells: that of a quadrilateral for its other diagonal.
class Flips {
 public:
  /// Works in place on `cells`, which must live longer.
  explicit Flips(MovedCells<2>& cells) : cells_(cells) {}

  /// Flips those of the edges that lie between positive cells and are not locally Delaunay, and what that makes so, until none is
  /// left (Lawson 1977): each flip lowers the surface that the cells make on the paraboloid z = |x|^2, which ends. Cells that
  /// it has changed.
  std::vector<int> make_delaunay(std::vector<FacetAt> edges);
  /// Makes facets edges of a Delaunay triangulation, and the rest Delaunay again as far as they allow (constrained Delaunay).
  /// One that crosses an earlier one is left out: two surfaces have met, and the winding number decides what lies between
  /// them. A node on a facet parts it.
  void keep(const std::vector<Facet<2>>& facets);

 private:
  using Cell = MovedCells<2>::Cell;

  bool flips(const FacetAt& edge) const;
  void flip(const FacetAt& edge);
  bool convex(const FacetAt& edge) const;
  std::optional<int> make_edge(int from, int to);
  int first_crossed(int from, int to, std::vector<FacetAt>& crossed) const;
  int crossed_by(int from, int to, std::vector<FacetAt>& crossed) const;
  std::optional<FacetAt> next_flip(int from, int to, const std::vector<FacetAt>& crossed) const;
  CGAL::Orientation side(int from, int to, int point) const { return cells_.orientation({from, to, point}); }
  bool is_kept(int a, int b) const { return kept_.contains(key(a, b)); }
  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }

  MovedCells<2>& cells_;
  std::vector<int> cell_of_;                // points: one around each
  std::vector<FacetAt> flipped_;            // edges around what has been flipped
  std::unordered_set<std::uint64_t> kept_;  // edges
};

/// All facets between points are edges.
bool has_edges(const ClosedDelaunay<2>& mesh, std::size_t points, const std::vector<Facet<2>>& facets);

}  // namespace splashdown::fluid
