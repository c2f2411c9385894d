// A body that forces move, in space: its compliance and its step. Internal to the rigid-body room.
#pragma once

#include "rigid/bodies.hpp"
#include "rigid/bullet_world.hpp"
#include "rigid/spin.hpp"

namespace splashdown::rigid {

class FreeBody {
 public:
  using Freedom = std::array<bool, freedoms<3>>;

  FreeBody(BulletWorld& world, double mass, const Inertia<3>& inertia, const Freedom& free,
           const BodyState<3>& start);

  Compliance<3> compliance_at(const Isometry<3>& pose) const;
  /// Of the begun step.
  const Compliance<3>& compliance() const { return compliance_; }

  /// Fixes the step: what the velocity becomes under the known impulse, and the compliance around that.
  void begin(const BodyState<3>& state, const Wrench<3>& impulse, double dt);
  void kick(BulletWorld& world, const Wrench<3>& impulse);
  BodyState<3> drifted(const BulletWorld& world) const;
  void commit(const Twist<3>& velocity);

  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< angular, about the centre of mass, at t_{n-1/2}

 private:
  std::array<bool, 3> spinning() const { return {free_[3], free_[4], free_[5]}; }
  Compliance<3> compliance_for(const Eigen::Matrix3d& world_inertia) const;

  double mass_;
  Inertia<3> inertia_;
  Freedom free_;
  std::size_t number_;  // in Bullet's world

  BodyState<3> state_{Isometry<3>::Identity(), Twist<3>::Zero()};
  Twist<3> unloaded_ = Twist<3>::Zero(), loaded_ = Twist<3>::Zero();  // velocities at t_{n+1/2}
  Compliance<3> compliance_ = Compliance<3>::Zero();
  Eigen::Matrix3d midpoint_inertia_ = Eigen::Matrix3d::Identity();
};

}  // namespace splashdown::rigid
