#include "fluid/effects/effect.hpp"

#include <limits>

namespace splashdown::fluid {

template <int d>
double Effect<d>::stable_dt() const {
  return std::numeric_limits<double>::infinity();
}

template class Effect<2>;
template class Effect<3>;

}  // namespace splashdown::fluid
