#include "coupling/interface_term.hpp"

namespace splashdown::coupling {

template <int d>
fluid::StandIn LaplacianTerm<d>::stand_in(const rigid::Bodies<d>& bodies, std::size_t body) const {
  const auto& spec = bodies.spec(body);
  if (spec.motion != rigid::Motion::free) return {};
  return {.laplacian = strength_ / spec.mass};
}

template <int d>
fluid::StandIn RobinTerm<d>::stand_in(const rigid::Bodies<d>& bodies, std::size_t body) const {
  const auto& spec = bodies.spec(body);
  if (spec.motion != rigid::Motion::free) return {};
  return {.robin = 1 / spec.mass};
}

template class LaplacianTerm<2>;
template class LaplacianTerm<3>;
template class RobinTerm<2>;
template class RobinTerm<3>;

}  // namespace splashdown::coupling
