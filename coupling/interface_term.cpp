#include "coupling/interface_term.hpp"

namespace splashdown::coupling {

template <int d>
fluid::WallResponse<d> LaplacianTerm<d>::response(const rigid::Bodies<d>& bodies, std::size_t body) const {
  const auto& spec = bodies.spec(body);
  if (spec.motion != rigid::Motion::free) return {};
  return {.stand_in = {.laplacian = strength_ / spec.mass}};
}

template <int d>
fluid::WallResponse<d> RobinTerm<d>::response(const rigid::Bodies<d>& bodies, std::size_t body) const {
  const auto& spec = bodies.spec(body);
  if (spec.motion != rigid::Motion::free) return {};
  return {.stand_in = {.robin = 1 / spec.mass}};
}

template class LaplacianTerm<2>;
template class LaplacianTerm<3>;
template class RobinTerm<2>;
template class RobinTerm<3>;

}  // namespace splashdown::coupling
