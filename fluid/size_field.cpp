#include "fluid/size_field.hpp"

#include <cmath>

namespace splashdown::fluid {

template <int d>
SizeField<d>::SizeField(const SizeSpec& spec, const WallsAt<d>& walls, std::span<const double> wetted,
                        std::span<const Vec<d>> x, const std::vector<Facet<d>>& boundary)
    : spec_(spec), walls_(walls), wall_size_(walls.walls.size()) {
  for (std::size_t w = 0; w < wall_size_.size(); ++w) {
    // Half the wetted measure as a length: the half width of a wetted bottom.
    const double length = 0.5 * std::pow(wetted[w], 1.0 / (d - 1));
    wall_size_[w] = std::max(walls.walls[w].spec().size, spec.wetted_fraction * length);
  }
  if (spec.surface >= spec.far) return;  // the far size already resolves the surface
  std::vector<const Facet<d>*> free;
  for (const auto& f : boundary)
    if (f.wall < 0) free.push_back(&f);
  Eigen::Matrix<double, d, Eigen::Dynamic> vertices(d, d * free.size());
  Eigen::Matrix<int, d, Eigen::Dynamic> facets(d, free.size());
  for (std::size_t f = 0; f < free.size(); ++f)
    for (int k = 0; k < d; ++k) {
      const int at = static_cast<int>(d * f) + k;
      vertices.col(at) = x[free[f]->nodes[k]];
      facets(k, f) = at;
    }
  surface_ = FacetTree<d>(std::move(vertices), std::move(facets));
}

template <int d>
double SizeField<d>::operator()(const Vec<d>& point) const {
  double h = spec_.far;
  for (std::size_t w = 0; w < wall_size_.size(); ++w) {
    const double reach = (h - wall_size_[w]) / spec_.growth;
    if (reach <= 0) continue;
    h = wall_size_[w] + spec_.growth * walls_.walls[w].distance_unsigned(walls_.poses[w], point, reach);
  }
  const double reach = (h - spec_.surface) / spec_.growth;
  if (!surface_.empty() && reach > 0)
    h = spec_.surface + spec_.growth * std::sqrt(surface_.nearest(point, reach).squared_distance);
  return h;
}

template class SizeField<2>;
template class SizeField<3>;

}  // namespace splashdown::fluid
