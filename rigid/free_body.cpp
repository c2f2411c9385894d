#include "rigid/free_body.hpp"

#include <limits>

namespace splashdown::rigid {

FreeBody::FreeBody(BulletWorld& world, double mass, const Inertia<3>& inertia, const Freedom& free,
                   const BodyState<3>& start)
    : momentum(world_inertia(start.pose.linear(), inertia) * start.velocity.tail<3>()),
      mass_(mass),
      inertia_(inertia),
      free_(free),
      number_(world.add(mass, inertia, free)) {}

Compliance<3> FreeBody::compliance_for(const Eigen::Matrix3d& world_inertia) const {
  Compliance<3> c = Compliance<3>::Zero();
  for (int i = 0; i < 3; ++i) c(i, i) = free_[static_cast<std::size_t>(i)] ? 1 / mass_ : 0;
  c.bottomRightCorner<3, 3>() = rotational_compliance(world_inertia, spinning());
  return c;
}

Compliance<3> FreeBody::compliance_at(const Isometry<3>& pose) const {
  return compliance_for(world_inertia(pose.linear(), inertia_));
}

void FreeBody::begin(const BodyState<3>& state, const Wrench<3>& impulse, double dt) {
  state_ = state;
  const SpinState before{state.pose.linear(), state.velocity.tail<3>(), momentum};
  const SpinStep spin = spin_step(inertia_, spinning(), before, impulse.tail<3>(), dt);
  midpoint_inertia_ = spin.inertia;
  compliance_ = compliance_for(spin.inertia);
  unloaded_ = state.velocity + compliance_ * impulse;
  unloaded_.tail<3>() = spin.velocity;
}

void FreeBody::kick(BulletWorld& world, const Wrench<3>& impulse) {
  loaded_ = unloaded_ + compliance_ * impulse;
  const Twist<3> change = loaded_ - state_.velocity;
  world.kick(number_, state_.pose, state_.velocity, change.allFinite() ? change : Twist<3>::Zero().eval());
}

BodyState<3> FreeBody::drifted(const BulletWorld& world) const {
  if (loaded_.allFinite()) return {world.pose(number_), world.velocity(number_)};
  BodyState<3> lost{Isometry<3>::Identity(), loaded_};
  lost.pose.matrix().topRows<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
  return lost;
}

void FreeBody::commit(const Twist<3>& velocity) { momentum = midpoint_inertia_ * velocity.tail<3>(); }

}  // namespace splashdown::rigid
