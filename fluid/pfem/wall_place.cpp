#include "fluid/pfem/wall_place.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::fluid {
namespace {

constexpr int most_parts = 8;  // along a facet's edge: a fluid coarser than that is asked about

// Of a facet that is cut into `parts` along each edge: Gauss's two points on each part, or the middles of the edges of each
// triangle. Both are exact for quadratic functions.
void add_points(int parts, std::vector<FacetPoint<2>>& out) {
  const double gauss = 0.5 / std::sqrt(3.0);
  for (int k = 0; k < parts; ++k)
    for (double at : {0.5 - gauss, 0.5 + gauss}) {
      const double along = (k + at) / parts;
      out.push_back({{1 - along, along}, 0.5 / parts});
    }
}
void add_points(int parts, std::vector<FacetPoint<3>>& out) {
  const double weight = 1.0 / (3 * parts * parts);
  const auto corner = [&](int i, int j) -> Vec<3> {
    return Vec<3>(static_cast<double>(parts - i - j), static_cast<double>(i), static_cast<double>(j)) / parts;
  };
  const auto triangle = [&](const std::array<Vec<3>, 3>& at) {
    for (int k = 0; k < 3; ++k) {
      const Vec<3> middle = 0.5 * (at[k] + at[(k + 1) % 3]);
      out.push_back({{middle[0], middle[1], middle[2]}, weight});
    }
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j) {
      triangle({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
      if (i + j + 1 < parts) triangle({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
}

}  // namespace

template <int d>
std::span<const FacetPoint<d>> points_of_facet(const WallShape<d>& shape, double size) {
  static const auto tables = [] {
    std::array<std::vector<FacetPoint<d>>, most_parts> out;
    for (int parts = 1; parts <= most_parts; ++parts) add_points(parts, out[parts - 1]);
    return out;
  }();
  const double parts = shape.spacing > 0 ? std::ceil(size / shape.spacing) : 1.0;
  return tables[static_cast<std::size_t>(std::clamp(parts, 1.0, static_cast<double>(most_parts))) - 1];
}

template std::span<const FacetPoint<2>> points_of_facet(const WallShape<2>&, double);
template std::span<const FacetPoint<3>> points_of_facet(const WallShape<3>&, double);

}  // namespace splashdown::fluid
