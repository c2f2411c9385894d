#include <limits>

#include "fluid/term.hpp"

namespace splashdown::fluid {

template <int d>
double Term<d>::stable_dt() const {
  return std::numeric_limits<double>::infinity();
}

template <int d>
void Gravity<d>::predict(const Nodes<d>&, const Mesh<d>&, std::span<const double>, double kick,
                         std::span<Vec<d>> v) {
  for (auto& u : v) u += kick * g_;
}

template class Term<2>;
template class Term<3>;
template class Gravity<2>;
template class Gravity<3>;

}  // namespace splashdown::fluid
