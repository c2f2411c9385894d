#include "rigid/constraints/pull.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace splashdown::rigid {

double weight_of_later(double z) {
  if (z < 1e-3) return 0.5 + z / 12;
  return std::isfinite(z) ? -1 / std::expm1(-z) - 1 / z : 1;
}

template <int d>
double Pull<d>::at(double later) const {
  const double J = impulse + inertia * later;
  return one_sided ? std::max(J, 0.0) : J;
}

template <int d>
Pull<d> tension_only(const Stretch& spring, const StretchAt& at) {
  const double k = spring.stiffness, c = spring.damping, dt_before = 2 * at.kick - at.dt;
  Pull<d> pull;
  if (at.q - dt_before * at.rate / 2 >= 0) {
    const double later = weight_of_later(at.kick * c * at.compliance);
    pull.impulse = at.kick * (k * (at.q - dt_before / 4 * at.rate) + (1 - later) * c * at.rate);
    pull.inertia = at.kick * (k * at.dt / 4 + later * c);
  } else {  // it is taut for the share q_+/(q_+ - q_-) of the kick; a damper acts as long
    const double per_length = at.kick * k / 2 + c;
    pull.impulse = per_length * at.q;
    pull.inertia = per_length * at.dt / 2;
  }
  return pull;
}

template <int d>
double compliance(const Condition<d>& rate, std::span<const BodySpec<d>> specs, std::span<const BodyState<d>> states,
                  std::span<const char> held) {
  const auto of = [&](std::size_t body, const Wrench<d>& wrench) {
    const BodySpec<d>& spec = specs[body];
    const bool on_path = spec.motion == BodyMotion::prescribed && (!spec.release || held[body]);
    if (spec.motion == BodyMotion::fixed || on_path) return 0.0;
    if (spec.mass == 0) return std::numeric_limits<double>::infinity();
    const Vec<d> force = wrench.template head<d>();
    Rotation<d> moment = wrench.template tail<rotations<d>>();
    if constexpr (d == 3) moment = states[body].pose.linear().transpose() * moment;
    return force.squaredNorm() / spec.mass + moment.dot(spec.inertia.ldlt().solve(moment));
  };
  return of(rate.body, rate.first) + (rate.other ? of(*rate.other, rate.second) : 0.0);
}

template struct Pull<2>;
template struct Pull<3>;
template Pull<2> tension_only<2>(const Stretch&, const StretchAt&);
template Pull<3> tension_only<3>(const Stretch&, const StretchAt&);
template double compliance<2>(const Condition<2>&, std::span<const BodySpec<2>>, std::span<const BodyState<2>>,
                              std::span<const char>);
template double compliance<3>(const Condition<3>&, std::span<const BodySpec<3>>, std::span<const BodyState<3>>,
                              std::span<const char>);

}  // namespace splashdown::rigid
