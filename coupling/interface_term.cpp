#include "coupling/interface_term.hpp"

#include <cmath>
#include <numbers>

#include "rigid/mass_properties.hpp"

namespace splashdown::coupling {
namespace {

// Radius of the circle or sphere of equal volume.
double equal_radius(double area, std::integral_constant<int, 2>) { return std::sqrt(area / std::numbers::pi); }
double equal_radius(double volume, std::integral_constant<int, 3>) {
  return std::cbrt(3 * volume / (4 * std::numbers::pi));
}

// lambda for which the surface Laplacian equals B^T C B on the mode p ~ n: its eigenvalue is (d - 1) / a^2,
// and B n = |hull| / d for each direction.
double matched(double a, double mass, std::integral_constant<int, 2>) { return std::numbers::pi * a * a * a / mass; }
double matched(double a, double mass, std::integral_constant<int, 3>) {
  return 4 * std::numbers::pi * a * a / 3 * a * a / (2 * mass);
}

}  // namespace

template <int d>
fluid::WallResponse<d> LaplacianTerm<d>::response(const rigid::Bodies<d>& bodies, std::size_t body) const {
  const auto& spec = bodies.spec(body);
  if (spec.motion != rigid::Motion::free) return {};
  const std::integral_constant<int, d> dimension;
  const double a = equal_radius(rigid::mass_properties<d>(spec.surface).mass, dimension);
  fluid::WallResponse<d> response;
  response.radius = a;
  response.laplacian = strength_ * matched(a, spec.mass, dimension);
  return response;
}

template class LaplacianTerm<2>;
template class LaplacianTerm<3>;

}  // namespace splashdown::coupling
