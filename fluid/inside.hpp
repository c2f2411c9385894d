// Is a point inside a closed set of oriented facets? Winding number by ray crossing.
//
// Facets are binned by the quantiles of their corners in the directions across the ray, so that graded
// boundaries cost O(log n) a query where facets do not pile up.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "fluid/mesh.hpp"

namespace splashdown::fluid {

template <int d>
class InsideTest {
 public:
  InsideTest(std::span<const Vec<d>> x, const std::vector<Facet<d>>& facets);
  /// Overlapping parts of the boundary count as inside (winding number 2), gaps between them do not.
  bool operator()(const Vec<d>& point) const;

 private:
  std::size_t bin(double across) const {
    return std::upper_bound(edges_.begin(), edges_.end(), across) - edges_.begin();
  }
  std::vector<std::array<Vec<d>, d>> corners_;
  std::vector<double> edges_;  // bin boundaries along axis 1
  std::vector<int> start_, member_;
};

extern template class InsideTest<2>;
extern template class InsideTest<3>;

}  // namespace splashdown::fluid
