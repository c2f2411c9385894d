// Is a point inside a closed set of oriented facets? Winding number by ray crossing.
//
// Facets are binned by the quantiles of their corners in the directions across the ray, so that graded
// boundaries cost O(log n) a query where facets do not pile up behind each other. In 3D rays go upwards: along a
// water surface they would meet a row of its facets.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/facet.hpp"

namespace splashdown {

/// A closed boundary, prepared for many points. Const calls may come from all threads.
template <int d>
class InsideTest {
 public:
  /// `facets`: closed, oriented out of what they enclose, between the points `x` [m]; both are copied.
  InsideTest(std::span<const Vec<d>> x, const std::vector<Facet<d>>& facets);
  /// Whether the winding number at x is positive. Overlapping parts of the boundary count as inside (winding number 2), gaps
  /// between them do not.
  bool operator()(const Vec<d>& x) const;

 private:
  /// Items by the bins, along one axis, that they reach into.
  struct Bins {
    std::vector<double> edges;
    std::vector<int> start, member;
    /// `range`: of an item along the axis; the bins hold equal numbers of lower ends.
    void fill(std::span<const int> items, const std::vector<std::array<double, 2>>& range, std::size_t per_bin);
    std::size_t of(double at) const { return std::upper_bound(edges.begin(), edges.end(), at) - edges.begin(); }
    std::span<const int> operator[](std::size_t bin) const {
      return std::span(member).subspan(start[bin], start[bin + 1] - start[bin]);
    }
    std::size_t count() const { return start.size() - 1; }
  };
  std::span<const int> near(const Vec<d>& point) const;

  std::vector<std::array<Vec<d>, d>> corners_;  // axes turned: rays go along axis 0
  Bins slabs_;                                  // along axis 1
  std::vector<Bins> cells_;                     // 3D: of each slab along axis 2
};

/// The same of one point alone: O(facets).
template <int d>
bool is_inside(std::span<const Vec<d>> x, const std::vector<Facet<d>>& facets, const Vec<d>& point);

extern template class InsideTest<2>;
extern template class InsideTest<3>;

}  // namespace splashdown
