#include "rigid/forces/applied/applied.hpp"

#include "core/geometry.hpp"

namespace splashdown::rigid {

template <int d>
void AppliedForces<d>::add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const {
  for (const auto& spec : specs_) {
    const auto& turn = at.states[spec.body].pose.linear();
    Vec<d> force = spec.force.at(at.time);
    Eigen::Matrix<double, rotations<d>, 1> moment = spec.moment.at(at.time);
    if (spec.turns_with_body) force = turn * force;
    if constexpr (d == 3)
      if (spec.turns_with_body) moment = turn * moment;
    wrenches[spec.body] += wrench_of<d>(turn * spec.point, force);
    wrenches[spec.body].template tail<rotations<d>>() += moment;
  }
}

template class AppliedForces<2>;
template class AppliedForces<3>;

}  // namespace splashdown::rigid
