#include "apps/scene/patch.hpp"

#include <limits>

#include "core/facet_tree.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {

template <int d>
PatchRegion<d> patch_region(const PatchEntry& entry, const rigid::Surface<d>& hull, const rigid::Vec<d>& origin) {
  if (!entry.centre) return box_region<d>(vec<d>(*entry.min) - origin, vec<d>(*entry.max) - origin);
  const rigid::Vec<d> centre = vec<d>(*entry.centre) - origin;
  const FacetTree<d> facets(hull.vertices, hull.facets);
  const int nearest = facets.nearest(centre, std::numeric_limits<double>::infinity()).facet;
  std::array<rigid::Vec<d>, d> corners;
  for (int k = 0; k < d; ++k) corners[static_cast<std::size_t>(k)] = hull.vertices.col(hull.facets(k, nearest));
  return disc_region<d>(centre, entry.radius.value_or(0), area_vector(corners).normalized());
}

template PatchRegion<2> patch_region<2>(const PatchEntry&, const rigid::Surface<2>&, const rigid::Vec<2>&);
template PatchRegion<3> patch_region<3>(const PatchEntry&, const rigid::Surface<3>&, const rigid::Vec<3>&);

}  // namespace splashdown::apps
