// What a closed surface encloses: is a point in it, how deep, and do two of them share space?
#pragma once

#include <optional>
#include <vector>

#include "apps/scene/geometry.hpp"
#include "core/facet_tree.hpp"
#include "core/surface/inside.hpp"

namespace splashdown::apps {

template <int d>
class Solid {
 public:
  explicit Solid(const rigid::Surface<d>& surface);
  /// Negative inside [m].
  double signed_distance(const rigid::Vec<d>& point) const;
  double distance(const rigid::Vec<d>& point) const;
  bool contains(const rigid::Vec<d>& point) const { return box_.contains(point) && search().inside(point); }
  /// Inside, and no facet is nearer than `depth` [m]: cheaper than to ask how far the nearest one is.
  bool contains(const rigid::Vec<d>& point, double depth) const;
  const rigid::Surface<d>& surface() const { return surface_; }
  const Extents<d>& extents() const { return box_; }
  /// FacetTree::meeting of its surface.
  std::vector<int> facets_near(const Extents<d>& box) const;

 private:
  struct Search {
    FacetTree<d> facets;
    InsideTest<d> inside;
  };
  // Made when first asked for: bodies whose boxes do not meet need none, and to make it took most of reading a scene in space.
  const Search& search() const;

  rigid::Surface<d> surface_;
  Extents<d> box_;
  mutable std::optional<Search> search_;
};

/// The interiors share more than their boundaries; with a depth, points that lie deeper than that in both [m], as far as places of
/// edges tell.
template <int d>
bool overlap(const Solid<d>& a, const Solid<d>& b, double depth = 0);

extern template class Solid<2>;
extern template class Solid<3>;

}  // namespace splashdown::apps
