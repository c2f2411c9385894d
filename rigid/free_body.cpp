#include "rigid/free_body.hpp"

namespace splashdown::rigid {

FreeBody::FreeBody(double mass, const Inertia<3>& inertia, const Freedom& free, const BodyState<3>& start)
    : momentum(world_inertia(start.pose.linear(), inertia) * start.velocity.tail<3>()),
      mass_(mass),
      inertia_(inertia),
      spinning_{free[3], free[4], free[5]} {}

void FreeBody::begin(const BodyState<3>& state, const Wrench<3>& impulse, double dt) {
  matrix_.setZero();
  impulse_ = impulse;
  if (mass_ == 0) return;
  matrix_.topLeftCorner<3, 3>().diagonal().setConstant(mass_);
  const SpinState before{state.pose.linear(), state.velocity.tail<3>(), momentum};
  const SpinStep spin = spin_step(inertia_, spinning_, before, impulse.tail<3>(), dt);
  matrix_.bottomRightCorner<3, 3>() = spin.inertia;
  impulse_.tail<3>() = spin.inertia * (spin.velocity - before.velocity);
}

void FreeBody::commit(const Twist<3>& velocity) { momentum = matrix_.bottomRightCorner<3, 3>() * velocity.tail<3>(); }

}  // namespace splashdown::rigid
