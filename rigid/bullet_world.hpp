// Bullet's world, double precision, without contacts: it kicks and drifts free bodies in space. Internal to
// the rigid-body room; bullet_world.cpp is the only file that includes Bullet.
//
//   s <- s + M^-1 J (impulse, free axes only),   x <- x + dt V,   R <- exp(dt w) R
//
// Leapfrog has two steps, kick and dt, Bullet has one: so a kick is an impulse and Bullet's step a mere
// drift. What Bullet does by itself and must not: 1/60 s quanta, gravity, damping, sleeping, its implicit
// gyroscopic term (loses energy at first order), and a silent stop at pi/4 of rotation a step.
#pragma once

#include <array>
#include <memory>

#include "rigid/types.hpp"

namespace splashdown::rigid {

class BulletWorld {
 public:
  BulletWorld();
  ~BulletWorld();

  /// Inertia in body axes; which of (V, w) in world axes impulses may change. Returns the body's number.
  std::size_t add(double mass, const Inertia<3>& inertia, const std::array<bool, 6>& free);

  /// Places a body and changes its velocity by the impulse that does so. Finite values only.
  void kick(std::size_t body, const Isometry<3>& pose, const Twist<3>& velocity, const Twist<3>& change);
  /// Moves all bodies.
  void drift(double dt);

  Isometry<3> pose(std::size_t body) const;
  Twist<3> velocity(std::size_t body) const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace splashdown::rigid
