#include "rigid/bodies.hpp"

namespace splashdown::rigid {

template <int d>
Wrench<d> Gravity<d>::wrench(const BodySpec<d>& body, const Isometry<d>&, const Twist<d>&, double) const {
  Wrench<d> weight = Wrench<d>::Zero();
  weight.template head<d>() = body.mass * acceleration_;
  return weight;
}

template class Gravity<2>;
template class Gravity<3>;

}  // namespace splashdown::rigid
