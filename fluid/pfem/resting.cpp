// Water at rest that need not be stepped.
#include <algorithm>

#include "fluid/pfem/fluid_state.hpp"

namespace splashdown::fluid {

template <int d>
bool Fluid<d>::is_at_rest() const {
  const auto& now = s_->water.now;
  if (!std::ranges::all_of(s_->water.effects, [](const auto& effect) { return effect->keeps_rest(); })) return false;
  if (std::ranges::any_of(now.nodes.spray, [](char flies) { return flies != 0; })) return false;
  constexpr double roundoff = 1e-9;  // of the speed of a fall by the water's extent: what steps leave of rest
  Eigen::AlignedBox<double, d> box;
  for (const auto& x : now.nodes.x) box.extend(x);
  const double still = roundoff * roundoff * s_->water.gravity().norm() * box.diagonal().norm();
  return std::ranges::all_of(now.nodes.v, [&](const Vec<d>& v) { return v.squaredNorm() <= still; });
}

template <int d>
bool Fluid<d>::is_waiting() const {
  return !s_->water.now.resting_loads.empty();
}

template <int d>
void Fluid<d>::set_waiting(bool waits) {
  State& s = *s_;
  if (waits == is_waiting()) return;
  s.water.now.resting_loads.clear();
  if (!waits) return;
  for (auto& load : s.result.loads) {
    load = {.physical = load.total(), .repair = Wrench<d>::Zero(), .wetted = load.wetted};
    s.water.now.resting_loads.push_back(load.physical);
  }
}

template <int d>
void Fluid<d>::wait(double dt, std::span<const WallPlace<d>> places, std::span<const WallVelocity<d>> velocities) {
  Present<d>& now = s_->water.now;
  now.time += dt;
  now.dt = dt;
  now.poses.assign(places.begin(), places.end());
  now.velocity.assign(velocities.begin(), velocities.end());
  s_->water.prepared = s_->solved = false;
}

template bool Fluid<2>::is_at_rest() const;
template bool Fluid<3>::is_at_rest() const;
template bool Fluid<2>::is_waiting() const;
template bool Fluid<3>::is_waiting() const;
template void Fluid<2>::set_waiting(bool);
template void Fluid<3>::set_waiting(bool);
template void Fluid<2>::wait(double, std::span<const WallPlace<2>>, std::span<const WallVelocity<2>>);
template void Fluid<3>::wait(double, std::span<const WallPlace<3>>, std::span<const WallVelocity<3>>);

}  // namespace splashdown::fluid
