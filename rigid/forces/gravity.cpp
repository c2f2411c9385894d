#include "rigid/forces/gravity.hpp"

namespace splashdown::rigid {

template <int d>
void Gravity<d>::add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const {
  for (std::size_t i = 0; i < wrenches.size(); ++i) wrenches[i].template head<d>() += at.specs[i].mass * acceleration_;
}

template class Gravity<2>;
template class Gravity<3>;

}  // namespace splashdown::rigid
