#include "apps/new/measures.hpp"

#include <algorithm>
#include <array>

#include "core/geometry.hpp"

namespace splashdown::apps {
namespace {

/// What is seen from above; parts behind others count, too [m, m^2].
template <int d>
double plan_of(const rigid::Surface<d>& hull) {
  double plan = 0;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f) {
    std::array<rigid::Vec<d>, d> corners;
    for (int k = 0; k < d; ++k) corners[static_cast<std::size_t>(k)] = hull.vertices.col(hull.facets(k, f));
    plan += std::max(0., -area_vector(corners)[d - 1]);
  }
  return plan;
}

}  // namespace

template <int d>
Measures<d> measures_of(const Body& body) {
  const auto hull = outline<d>(body);
  Measures<d> m;
  m.box = extents<d>(hull);
  m.length = m.box.sizes()[0];
  m.breadth = m.box.sizes()[d - 2];
  m.height = m.box.sizes()[d - 1];
  m.plan = plan_of<d>(hull);
  m.volume = shape_of<d>(body.shape).at_unit_density.mass;
  return m;
}

template Measures<2> measures_of<2>(const Body&);
template Measures<3> measures_of<3>(const Body&);

}  // namespace splashdown::apps
